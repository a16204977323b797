#include "study/usual_tolerances.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
#include <sstream>

#include "gear/tolerance_class.hpp"
#include "model/error.hpp"
#include "study/detail/drawing_axis.hpp"
#include "study/detail/gear_reader.hpp"

namespace gearsweep {
namespace {

constexpr double kSigmas = 3.0;  // of a process that just keeps its tolerance

bool is_on_axis(const Study& study, std::string_view name) {
  for (const Axis& axis : study.axes) {
    if (axis.name == name) return true;
  }
  return false;
}

// What a study calls a key of the drawing: "torque_N_m", or "torque_N_m_first".
std::string name_of(const DrawingTable& from, std::string_view key) {
  return std::string(key) + from.suffix;
}

// Whether the drawing gives the key as one number, which no axis has.
std::optional<double> one_number(const Study& study, const DrawingTable& from, const GearKey& key) {
  const toml::node* node = from.table->get(key.name);
  if (node == nullptr || !node->is_number() || is_on_axis(study, name_of(from, key.name))) {
    return std::nullopt;
  }
  return node->value<double>();
}

// What the drawing gives one of a pair, which no axis has; nothing where that is 0.
std::optional<double> one_of_pair(const Study& study, const DrawingTable& from, const GearKey& key,
                                  std::size_t member) {
  const toml::node* node = from.table->get(key.name);
  if (node != nullptr && node->is_array()) node = node->as_array()->get(member);
  const bool is_swept = is_on_axis(study, name_of(from, key.name)) ||
                        is_on_axis(study, name_of(from, member_name(key, member)));
  const double value = node == nullptr || is_swept ? 0.0 : node->value_or(0.0);
  return value == 0.0 ? std::nullopt : std::optional(value);
}

// The standard deviation of the first harmonic of the transmission error, um. A deviation h of the
// slope of a flank is a saw of the mesh, whose first harmonic is h/pi (its Fourier series); a form
// deviation, from highest to lowest, is taken as one wave of half of that. Both gears add up.
double error_deviation(const std::array<FlankTolerances, 2>& gears) {
  double squares = 0.0;
  for (const FlankTolerances& gear : gears) {
    squares += std::pow(gear.profile_slope / kSigmas / std::numbers::pi, 2);
    squares += std::pow(gear.profile_form / (2.0 * kSigmas), 2);
  }
  return std::sqrt(squares);
}

std::array<FlankTolerances, 2> flanks_of(const GearDrawing& drawing, int tolerance_class) {
  std::array<FlankTolerances, 2> gears;
  const double module = drawing.required(kModule);
  const double slant = drawing.number(kHelix).value_or(0.0) * std::numbers::pi / 180.0;
  for (std::size_t i = 0; i < gears.size(); ++i) {
    const double diameter = module / std::cos(slant) * drawing.list(kTeeth)[i];
    const std::optional<FlankTolerances> own =
        flank_tolerances({diameter, module, tolerance_class});
    if (!own) {
      throw InputError(fmt::format(
          "ISO 1328-1 has no class {} for a gear of {:.4g} mm with the module {:.4g} mm: it goes "
          "from 1 to 11, 5 to 15000 mm and 0.5 to 70 mm; give the study an [uncertain] table",
          tolerance_class, diameter, module));
    }
    gears[i] = *own;
  }
  return gears;
}

// Whether the axis gives the parameter, itself or through a column in proportion to it.
bool gives_in_proportion(const Axis& axis, std::size_t parameter) {
  for (const Swept& one : axis.swept()) {
    if (one.is_state || one.index != parameter || axis.swept().size() > 1) continue;
    const double ratio = one.values.front() / axis.values.front();
    for (std::size_t i = 0; i < axis.values.size(); ++i) {
      const double off = one.values[i] - ratio * axis.values[i];
      if (std::abs(off) > 1e-12 * std::abs(one.values[i])) return false;  // rounding
    }
    return true;
  }
  return false;
}

// Both of a pair in a draw, as TOML has them: what the drawing gives where no draw does.
std::string pair_of_draw(const Study& study, const SweptKey& key, std::size_t draw) {
  const toml::node* node = key.from.table->get(key.key->name);
  std::array<double, 2> both = {};
  for (std::size_t i = 0; i < both.size() && node != nullptr; ++i) {
    both[i] = (node->is_array() ? *node->as_array()->get(i) : *node).value_or(0.0);
  }
  for (std::size_t i = 0; i < both.size(); ++i) {
    const std::string name = SweptKey{key.key, key.from, i}.name();
    for (const UncertainParameter& parameter : study.uncertain.parameters) {
      if (parameter.draws.name == name) both[i] = parameter.draws.values[draw];
    }
  }
  return fmt::format("[{}, {}]", both[0], both[1]);
}

// The override that multiplies the values of the axis that gives a parameter.
std::string scaled_axis(const Study& study, std::size_t parameter, double factor) {
  bool is_found = false;
  std::vector<std::string> axes;
  for (const Axis& axis : study.axes) {
    const bool scales = gives_in_proportion(axis, parameter);
    is_found = is_found || scales;
    std::vector<double> values = axis.values;
    for (double& value : values) value *= scales ? factor : 1.0;
    axes.push_back(
        fmt::format("{{name = \"{}\", values = [{}]}}", axis.name, fmt::join(values, ", ")));
  }
  if (!is_found) {
    throw InputError(fmt::format(
        "{0} scatters about what an axis gives, which is not in proportion to it: sweep {0} itself",
        study.model->parameters[parameter].name));
  }
  return fmt::format("axes=[{}]", fmt::join(axes, ", "));
}

// Adds the runout of a gear that has one in its drawing: as wide as the class allows, and at any
// place of the turn. Half of the runout, from highest to lowest, is the eccentricity.
void add_runout(const Study& study, const DrawingTable& from, const GearDrawing& drawing,
                int tolerance_class, std::vector<UsualTolerance>* all) {
  for (std::size_t i = 0; i < kRunout.count(); ++i) {
    if (!one_of_pair(study, from, kRunout, i)) continue;
    const double deviation = flanks_of(drawing, tolerance_class)[i].runout / (2.0 * kSigmas);
    all->push_back(
        {name_of(from, member_name(kRunout, i)),
         fmt::format(R"({{distribution = "normal", std = {:.4g}, folded = true}})", deviation),
         fmt::format("runout by ISO 1328-1 class {}, half of which is the eccentricity",
                     tolerance_class)});
  }
  // Where the numbers of teeth have no common factor, any two teeth meet, however they begin.
  const std::vector<double>& teeth = drawing.list(kTeeth);
  const bool have_own_pairs = std::gcd(std::lround(teeth[0]), std::lround(teeth[1])) > 1;
  if (!have_own_pairs || !one_of_pair(study, from, kRunout, 0) ||
      !one_of_pair(study, from, kRunout, 1) ||
      is_on_axis(study, name_of(from, kRunoutPhase.name))) {
    return;
  }
  all->push_back({name_of(from, member_name(kRunoutPhase, 0)),
                  R"({distribution = "uniform", from = 0.0, to = 360.0})",
                  "the gears are mounted with any teeth in mesh"});
}

// What a study without a drawing may give a tolerance to.
std::string name_to_scatter(const Study& study) {
  const std::optional<std::size_t> load = study.model->parameter_of(Role::load);
  return load ? study.model->parameters[*load].name : study.model->parameters.front().name;
}

// What scatters of one drawing; with the first of them, friction.
void add_of_drawing(const Study& study, const DrawingTable& from, const GearDrawing& drawing,
                    int tolerance_class, bool is_first, std::vector<UsualTolerance>* all) {
  const auto add = [&](std::string_view key, std::string distribution, std::string reason) {
    all->push_back({name_of(from, key), std::move(distribution), std::move(reason)});
  };
  if (one_number(study, from, kTorque)) {
    add(kTorque.name, R"({distribution = "normal", std = 0.05, relative = true})",
        "estimate: the mean load is known to 5 % (one standard deviation)");
  }
  if (const auto error = one_number(study, from, kTransmissionError)) {
    const double deviation = error_deviation(flanks_of(drawing, tolerance_class));
    add(kTransmissionError.name,
        fmt::format(R"({{distribution = "normal", std = {:.4g}, folded = true}})", deviation),
        fmt::format("profile slope and form of both gears by ISO 1328-1 class {}, as one wave of "
                    "the mesh",
                    tolerance_class));
  }
  add_runout(study, from, drawing, tolerance_class, all);
  if (is_first && study.model->find_parameter("mu") >= 0 && !is_on_axis(study, "mu")) {
    all->push_back(
        {"mu",
         R"({distribution = "triangular", from = 0.6, mode = 1.0, to = 1.4, relative = true})",
         "estimate: friction is known to 40 % at most"});
  }
  if (one_number(study, from, kHalfBacklash)) {
    add(kHalfBacklash.name, R"({distribution = "uniform", from = 0.7, to = 1.3, relative = true})",
        "estimate: tooth thickness and centre distance leave 30 % of the backlash open");
  }
  if (one_number(study, from, kDampingRatio)) {
    add(kDampingRatio.name,
        R"({distribution = "triangular", from = 0.5, mode = 1.0, to = 1.5, relative = true})",
        "estimate: damping is known to 50 % at most");
  }
  const std::string factor = name_of(from, kStiffnessFactor.name);
  if (study.model->find_parameter(factor) >= 0 &&
      (from.table->get(kStiffnessFactor.name) == nullptr
           ? !is_on_axis(study, factor)
           : one_number(study, from, kStiffnessFactor).has_value())) {
    add(kStiffnessFactor.name,
        R"({distribution = "triangular", from = 0.8, mode = 1.0, to = 1.05, relative = true})",
        "estimate: misaligned shafts leave 80 % of the face width bearing at least "
        "(K_Hbeta of 2.5)");
  }
  if (one_number(study, from, kBearingStiffness)) {
    add(kBearingStiffness.name, R"({distribution = "normal", std = 0.1, relative = true})",
        "estimate: 10 % (one standard deviation)");
  }
}

}  // namespace

std::vector<UsualTolerance> usual_tolerances(const Study& study, int tolerance_class) {
  const toml::table root = toml::parse(study.toml);
  std::vector<DrawingTable> drawings = drawing_tables(root, *study.model);
  std::erase_if(drawings, [](const DrawingTable& from) { return from.table == nullptr; });
  if (drawings.empty()) {
    throw InputError(fmt::format(
        "what scatters is not known: usual tolerances are those of a study with a [gear] table; "
        "give the study an [uncertain] table, such as\n  [uncertain]\n  {} = {{distribution = "
        "\"normal\", std = 0.05, relative = true}}",
        name_to_scatter(study)));
  }
  std::vector<UsualTolerance> all;
  for (const DrawingTable& from : drawings) {
    const bool is_first = &from == &drawings.front();
    const GearValues values = first_values(root, *study.model, from, study.axes);
    add_of_drawing(study, from, read_drawing(from, values), tolerance_class, is_first, &all);
  }
  return all;
}

std::string scaled_tolerance(const Study& study, const std::string& name, double factor) {
  const toml::table root = toml::parse(study.toml);
  toml::table entry = *root["uncertain"][name].as_table();
  const auto number = [&](const char* key) { return entry[key].value<double>(); };
  const auto scale = [&](const char* key, double middle) {
    entry.insert_or_assign(key, middle + factor * (*number(key) - middle));
  };
  if (entry.contains("values")) return "";
  if (entry.contains("std")) {
    scale("std", 0.0);
  } else if (const std::optional<double> mode = number("mode")) {
    scale("from", *mode);
    scale("to", *mode);
  } else {
    const double middle = 0.5 * (*number("from") + *number("to"));
    scale("from", middle);
    scale("to", middle);
  }
  std::ostringstream text;
  text << toml::toml_formatter(
      entry, toml::toml_formatter::default_flags & ~toml::format_flags::indentation);
  // An entry of a table on one line.
  std::string line = "{";
  std::istringstream rows(text.str());
  for (std::string row; std::getline(rows, row);) {
    if (!row.empty()) line += (line.size() > 1 ? ", " : "") + row;
  }
  return line + "}";
}

std::vector<std::string> overrides_of_draw(const Study& study, std::size_t draw) {
  std::vector<std::string> overrides = {"uncertain={}"};
  for (const UncertainParameter& parameter : study.uncertain.parameters) {
    const Axis& draws = parameter.draws;
    double value = draws.values[draw];
    if (draws.is_list) {  // a key of [gear], or of [gear.first]
      const toml::table root = toml::parse(study.toml);
      const SweptKey key = find_swept_key(root, *study.model, draws.name).value();
      const std::string heading = key.from.heading.substr(1, key.from.heading.size() - 2);
      overrides.push_back(
          fmt::format("{}.{}={}", heading, key.key->name,
                      key.member ? pair_of_draw(study, key, draw) : fmt::format("{}", value)));
      continue;
    }
    if (parameter.is_factor) {
      if (study.find_on_axes(draws.index) != nullptr) {
        overrides.push_back(scaled_axis(study, draws.index, value));
        continue;
      }
      value *= study.setting.parameters[draws.index];
    }
    overrides.push_back(fmt::format("parameters.{}={}", draws.name, value));
  }
  return overrides;
}

}  // namespace gearsweep
