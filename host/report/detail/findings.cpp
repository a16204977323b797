#include "report/detail/findings.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "model/error.hpp"
#include "model/names.hpp"
#include "model/version.hpp"
#include "plan/plan.hpp"
#include "report/detail/words.hpp"
#include "result/order_dataset.hpp"
#include "result/si_units.hpp"
#include "sweep/sweep.hpp"

namespace gearsweep {
namespace {

double period_at(const Plan& plan, std::size_t point) {
  return plan.study().model->period(plan.setting_of(point));
}

// Fills in what an engineer asks for and the model has: the force first, which tells the worst
// speeds.
void choose_quantities(const Model& model, ReportFindings* findings) {
  const std::string& first = model.states.front().name;
  const std::vector<Quantity> offered = offered_quantities(model);
  std::vector<std::string>& wanted = findings->quantities;
  const auto add_signals = [&](Role role, const std::string& ending) {
    for (const ChannelInfo& signal : model.signals_of(role)) wanted.push_back(signal.name + ending);
  };
  add_signals(Role::mesh_force, "_max");
  add_signals(Role::mesh_force, "_std");
  if (wanted.empty()) wanted = {first + "_max", first + "_rms"};
  for (const Quantity& quantity : offered) {
    if (!quantity.divided_by) continue;
    wanted.push_back(quantity.name);
    if (findings->load_factor.empty()) findings->load_factor = quantity.name;
    const bool is_of_load = quantity.divided_by == model.parameter_of(Role::load);
    if (findings->iso_load_factor.empty() && is_of_load) findings->iso_load_factor = quantity.name;
  }
  for (const Quantity& quantity : offered) {
    if (!quantity.name.ends_with("contact_gap")) continue;
    wanted.push_back(quantity.name);
    findings->apart.push_back(quantity.name);
  }
  wanted.emplace_back("contact_class");
  add_signals(Role::transmission_error, "_peak_to_peak");
  add_signals(Role::bearing_force, "_max");
  std::erase_if(wanted, [&](const std::string& name) {
    return std::none_of(offered.begin(), offered.end(),
                        [&](const Quantity& quantity) { return quantity.name == name; });
  });
  findings->force = wanted.front();
  const ChannelInfo* const force = model.contact_force();
  findings->vibration = force == nullptr ? findings->force : force->name + "_std";
}

// So many that the slowest speed has lines up to four times the fastest mesh frequency.
double enough_orders(const Study& study) {
  constexpr double kFewest = 10.0, kMost = 40.0, kShown = 4.0;
  const Plan plan(study, study.points());
  const double first = period_at(plan, 0), last = period_at(plan, study.points() - 1);
  return std::clamp(std::ceil(kShown * std::max(first / last, last / first)), kFewest, kMost);
}

// K_v at each point. Over `resonance` the mesh frequency is the standard's resonance ratio.
// What a drawing gives has a load.
std::vector<double> dynamic_factors_of(const Study& study) {
  const Plan plan(study, study.points());
  const Model& model = *study.model;
  const std::size_t load = model.parameter_of(Role::load).value();
  std::vector<double> factors;
  for (std::size_t point = 0; point < study.points(); ++point) {
    const ModelSetting setting = plan.setting_of(point);
    const double mesh_frequency =
        2.0 * std::numbers::pi * model.mesh_periods(setting) / model.period(setting);
    factors.push_back(dynamic_factor(
        *study.dynamic_factor, study.dynamic_factor->line_load_per_load * setting.parameters[load],
        mesh_frequency / study.dynamic_factor->resonance));
  }
  return factors;
}

// The largest finite value of a map; minus infinity without one.
double most_of(const SweepResult& line, const std::string& quantity) {
  const std::vector<Quantity>& all = line.study.selection.quantities;
  const auto found = std::ranges::find(all, quantity, &Quantity::name);
  double most = -std::numeric_limits<double>::infinity();
  if (found == all.end()) return most;
  for (const double value : line.values[static_cast<std::size_t>(found - all.begin())]) {
    if (std::isfinite(value)) most = std::max(most, value);
  }
  return most;
}

// Chooses the mesh of the largest load factor: forces of meshes with other loads and radii cannot
// be compared.
void choose_mesh(const SweepResult& line, ReportFindings* findings) {
  const std::vector<ChannelInfo> forces = line.study.model->signals_of(Role::mesh_force);
  if (forces.size() < 2) return;
  double most = -std::numeric_limits<double>::infinity();
  for (const ChannelInfo& force : forces) {
    const std::string factor = load_factor_of(*line.study.model, force);
    const double own = most_of(line, factor);
    if (!(own > most)) continue;
    most = own;
    findings->mesh = force_words(force);
    findings->load_factor = factor;
    findings->force = force.name + "_max";
    findings->vibration = findings->force;
  }
}

void choose_ranking(const SweepResult& line, ReportFindings* findings) {
  constexpr double kClearly = 1.2;
  const Study& study = findings->line;
  findings->jump = static_jump(*study.model, Plan(study, study.points()).setting_of(0));
  findings->ranking = findings->vibration;
  if (findings->load_factor.empty()) return;
  const std::vector<Quantity>& quantities = line.study.selection.quantities;
  const auto factor = std::ranges::find(quantities, findings->load_factor, &Quantity::name);
  for (const double value : line.values[static_cast<std::size_t>(factor - quantities.begin())]) {
    if (std::isfinite(value) && value > kClearly * findings->jump) {
      findings->ranking = findings->force;
    }
  }
}

// The runs of a report.
class Runs {
 public:
  Runs(const ReportOptions& options, ReportFindings* out)
      : options_(options), out_(*out), sweep_(options.sweep_options()) {}

  // False when stopped.
  bool run(const Study& study, const std::string& file, const std::string& what) {
    return sweep(study, file, what).has_value();
  }

  // The curves over the speed, and K_v beside them.
  bool run_line() {
    std::optional<SweepResult> result = sweep(out_.line, "line.nc", "curves over speed");
    if (!result) return false;
    choose_mesh(*result, &out_);
    choose_ranking(*result, &out_);
    if (!out_.line.dynamic_factor) return true;
    out_.dynamic_factors = dynamic_factors_of(out_.line);
    const std::vector<Quantity>& quantities = result->study.selection.quantities;
    const auto load_factor = std::ranges::find(quantities, out_.iso_load_factor, &Quantity::name);
    result->values[static_cast<std::size_t>(load_factor - quantities.begin())] =
        out_.dynamic_factors;
    write_result(*result, out_.file("factor.nc"), provenance());
    return true;
  }

  bool map_orders_of_line() {
    if (options_.on_step) options_.on_step("order map");
    std::vector<std::string> overrides =
        pilot_step_ ? pilot_step_->overrides() : std::vector<std::string>{"integrate.tolerance=0"};
    if (out_.line.is_chained()) {
      overrides.push_back("initial.along=" + out_.line.axes[out_.speed].name);
    }
    Study study = changed(out_.line, overrides, {});
    study.integrate.record = usual_order_record(study);
    OrderRequest request;
    request.over = study.axes[out_.speed].name;
    request.orders = enough_orders(study);
    std::optional<OrderMap> map = map_orders(study, request, sweep_);
    if (!map) return false;
    write_orders(*map, out_.file("orders.nc"), provenance());
    out_.orders = *std::move(map);
    return true;
  }

  // Both directions, where the study can go along its speed.
  bool run_directions() {
    const std::string along = "initial.along=" + out_.line.axes[out_.speed].name;
    for (const auto& [policy, file, what] : {std::tuple("forward", "up.nc", "run-up"),
                                             std::tuple("backward", "down.nc", "run-down")}) {
      Study study;
      try {
        study = changed(out_.line, {fmt::format("initial.policy={}", policy), along}, {});
      } catch (const InputError& error) {
        out_.no_directions = error.what();
        return true;
      }
      if (!run(study, file, what)) return false;
    }
    out_.has_directions = true;
    return true;
  }

 private:
  // Nothing when stopped.
  std::optional<SweepResult> sweep(const Study& study, const std::string& file,
                                   const std::string& what) {
    if (options_.on_step) options_.on_step(what);
    std::optional<SweepResult> result = run_sweep(study, sweep_);
    if (!result) return result;
    write_result(*result, out_.file(file), provenance());
    if (result->pilot) pilot_step_ = result->pilot->step;
    return result;
  }

  Provenance provenance() const { return {options_.command_line, version(), source_hash()}; }

  const ReportOptions& options_;
  ReportFindings& out_;
  SweepOptions sweep_;
  std::optional<FoundStep> pilot_step_;
};

std::string list_override(const std::vector<std::string>& quantities) {
  return fmt::format("observe.quantities=[\"{}\"]", fmt::join(quantities, "\", \""));
}

// The force, which comes first, and the contact.
std::vector<std::string> tolerated(const std::vector<std::string>& quantities) {
  std::vector<std::string> chosen = {quantities.front()};
  const std::string contact = "contact_class";
  if (std::ranges::find(quantities, contact) != quantities.end()) chosen.push_back(contact);
  return chosen;
}

}  // namespace

std::string load_factor_of(const Model& model, const ChannelInfo& force) {
  for (const Quantity& quantity : offered_quantities(model)) {
    if (quantity.divided_by && quantity.name.starts_with(force.name + "_")) return quantity.name;
  }
  return "";
}

Study changed(const Study& study, const std::vector<std::string>& overrides,
              const std::vector<std::string>& zooms) {
  return read_study(study.toml, "the study of the report", overrides, zooms);
}

std::size_t find_speed_axis(const Study& study) {
  const Plan plan(study, study.points());
  std::size_t stride = 1;
  for (std::size_t i = 0; i < study.axes.size(); ++i) {
    const Axis& axis = study.axes[i];
    const std::size_t last = (axis.values.size() - 1) * stride;
    stride *= axis.values.size();
    if (!axis.is_list && period_at(plan, 0) != period_at(plan, last)) return i;
  }
  if (study.model->is_clockless) {
    throw InputError(
        fmt::format("a report goes over the speed of a forcing, and nothing drives model '{}': "
                    "'gearsweep run', 'trace' and 'floquet' tell of its motions",
                    study.model->name));
  }
  const std::vector<std::string> names = names_of(study.axes);
  throw InputError(fmt::format(
      "a report goes over a speed, and the study has no axis that changes the period of the "
      "forcing{}{}: add one, as in\n  [[axes]]\n  name = \"omega\"\n  from = 0.4\n  to = 2.0\n  "
      "count = 100",
      names.empty() ? "" : ", only ", fmt::join(names, " and ")));
}

ResultMap ReportFindings::map(const std::string& stored, const std::string& quantity) const {
  ResultMap map = ResultFile(file(stored)).read(quantity);
  if (is_si()) convert_to_si(study.scales, &map);
  return map;
}

ResultMap ReportFindings::over_speed(const std::string& stored, const std::string& quantity) const {
  const ResultFile result(file(stored));
  std::optional<Cut> cut;
  if (at) cut = result.find_cut(at->first, at->second);
  ResultMap map = result.read(quantity, cut);
  if (is_si()) convert_to_si(study.scales, &map);
  return map;
}

std::optional<ReportFindings> find_for_report(const Study& study, const ReportOptions& options) {
  ReportFindings findings;
  findings.given = study;
  findings.speed = find_speed_axis(study);
  choose_quantities(*study.model, &findings);
  std::vector<std::string> overrides = {list_override(findings.quantities)};
  if (study.uncertain.draws() > 0) overrides.emplace_back("uncertain={}");
  findings.study = changed(study, overrides, {});
  std::vector<std::string> zooms;
  for (std::size_t i = 0; i < study.axes.size(); ++i) {
    if (i == findings.speed) continue;
    const Axis& other = findings.study.axes[i];
    if (other.is_list && other.name == kPointAxis) {
      throw InputError(
          "a report goes over a speed, and beside it the study has a list of points: leave out "
          "[points] and give one of its points, as in --set gear.torque_N_m=60; with speeds and a "
          "column time_share in it, a list without [[axes]] is a load spectrum, which has a "
          "report");
    }
    const double value = own_value(findings.study, other).value_or(other.values.front());
    findings.at = {study.axes[i].name, value};
    zooms.push_back(fmt::format("{}={}:{}:1", study.axes[i].name, value, value));
  }
  findings.line = changed(findings.study, {}, zooms);
  Runs runs(options, &findings);
  if (findings.at && !runs.run(findings.study, "map.nc", "map over both axes")) return std::nullopt;
  if (!runs.run_line()) return std::nullopt;
  if (study.uncertain.draws() > 0) {
    findings.tolerances = changed(study, {list_override(tolerated(findings.quantities))}, zooms);
    const bool is_run =
        runs.run(*findings.tolerances, "tolerances.nc",
                 fmt::format("{} draws of the tolerances", study.uncertain.draws()));
    if (!is_run) return std::nullopt;
  }
  if (!runs.map_orders_of_line() || !runs.run_directions()) return std::nullopt;
  return findings;
}

}  // namespace gearsweep
