#include "report/detail/scatter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "model/error.hpp"
#include "report/detail/findings.hpp"
#include "result/si_units.hpp"
#include "sweep/draw_maps.hpp"
#include "sweep/sweep.hpp"

namespace gearsweep {
namespace {

constexpr double kQuantile95 = 1.959964;  // of the normal distribution
constexpr std::size_t kMostGears = 100'000;
// So many draws tell well enough what a tolerance half as wide brings: the draws are the same.
constexpr std::size_t kMostTightened = 4000;

void judge_speeds(const ToleranceOptions& options, Scatter* scatter) {
  scatter->percentiles.clear();
  for (std::vector<double>& row : draws_of_points(scatter->result, scatter->target)) {
    scatter->percentiles.push_back(percentile_with_error(std::move(row), options.percentile));
  }
  const auto largest =
      std::ranges::max_element(scatter->percentiles, {}, [](const Percentile& one) {
        return std::isnan(one.value) ? -std::numeric_limits<double>::infinity() : one.value;
      });
  scatter->worst = static_cast<std::size_t>(largest - scatter->percentiles.begin());
}

// Whether teeth part in each draw at each point, of any mesh; not a number where that is not known.
std::vector<std::vector<double>> partings_of(const Scatter& scatter) {
  std::vector<std::vector<double>> rows;
  for (const Quantity& contact : scatter.study.selection.quantities) {
    if (contact.of_draws || !is_contact_class(contact.name)) continue;
    std::vector<std::vector<double>> own = draws_of_points(scatter.result, contact.name);
    for (std::vector<double>& row : own) {
      for (double& value : row) {
        if (std::isnan(value)) continue;
        const std::string& name = contact.flags.at(static_cast<std::size_t>(value));
        value = name == "single_sided" || name == "double_sided" ? 1.0 : 0.0;
      }
    }
    if (rows.empty()) {
      rows = std::move(own);
      continue;
    }
    for (std::size_t point = 0; point < rows.size(); ++point) {
      for (std::size_t draw = 0; draw < rows[point].size(); ++draw) {
        double& all = rows[point][draw];
        const double value = own[point][draw];
        all = std::isnan(all) || std::isnan(value) ? all + value : std::max(all, value);
      }
    }
  }
  return rows;
}

void judge_contact(Scatter* scatter) {
  const std::vector<std::vector<double>> rows = partings_of(*scatter);
  if (rows.empty()) return;
  std::set<std::size_t> known, parting;  // draws
  for (const std::vector<double>& row : rows) {
    double all = 0.0, lost = 0.0;
    for (std::size_t draw = 0; draw < row.size(); ++draw) {
      if (std::isnan(row[draw])) continue;
      known.insert(draw);
      ++all;
      if (row[draw] == 0.0) continue;
      parting.insert(draw);
      ++lost;
    }
    scatter->parting.push_back(lost / all);
  }
  scatter->parting_anywhere =
      static_cast<double>(parting.size()) / static_cast<double>(known.size());
}

void find_worst_gears(Scatter* scatter) {
  constexpr std::size_t kShown = 10;
  const std::vector<std::vector<double>> rows = draws_of_points(scatter->result, scatter->target);
  std::vector<WorstGear> gears;
  for (std::size_t draw = 0; draw < scatter->study.uncertain.draws(); ++draw) {
    WorstGear gear;
    gear.draw = draw;
    gear.value = -std::numeric_limits<double>::infinity();
    for (std::size_t point = 0; point < rows.size(); ++point) {
      if (!(rows[point][draw] > gear.value)) continue;
      gear.value = rows[point][draw];
      gear.point = point;
    }
    const auto has_none = [draw](const std::vector<double>& row) { return std::isnan(row[draw]); };
    if (std::ranges::any_of(rows, has_none)) ++scatter->without_value;
    if (std::isfinite(gear.value)) gears.push_back(std::move(gear));
  }
  std::ranges::stable_sort(gears, std::greater{}, &WorstGear::value);
  gears.resize(std::min(gears.size(), kShown));
  for (WorstGear& gear : gears) gear.overrides = overrides_of_draw(scatter->study, gear.draw);
  scatter->worst_gears = std::move(gears);
}

class ScatterRuns {
 public:
  ScatterRuns(const ToleranceOptions& options, Scatter* out) : options_(options), out_(*out) {}

  // The gears over the speeds; more of them until their percentile is known well enough.
  bool run_gears() {
    for (;;) {
      SweepOptions sweep = options_.sweep_options();
      // Each number of gears is a sweep of its own.
      if (!options_.journal_path.empty()) {
        sweep.journal_path = fmt::format("{}-{}", options_.journal_path, out_.gears());
      }
      std::optional<SweepResult> result =
          run(out_.study, sweep,
              fmt::format("{} gears at {} speeds", out_.gears(), out_.study.points()));
      if (!result) return false;
      out_.result = *std::move(result);
      judge_speeds(options_, &out_);
      const std::size_t more = gears_for_width();
      if (more <= out_.gears()) return true;
      out_.study = changed(out_.study, {fmt::format("uncertain.samples={}", more)});
    }
  }

  // At the worst speed: which tolerance makes the scatter, and what half of it would bring.
  bool rank() {
    out_.tightened_gears = std::min(out_.gears(), kMostTightened);
    const Study here = at_worst_speed();
    const std::size_t samples = std::clamp<std::size_t>(out_.gears() / 2, 40, 1000);
    const std::optional<SweepResult> sobol =
        run(changed(here, {"uncertain.sobol=true", "uncertain.keep=false",
                           fmt::format("uncertain.samples={}", samples)}),
            options_.sweep_options(), "which tolerance matters");
    if (!sobol) return false;
    const std::optional<double> now = percentile_at(here, {}, "the worst speed by itself");
    if (!now) return false;
    const std::vector<double>& first = map_of(*sobol, out_.target + "_sobol_first");
    const std::vector<double>& error = map_of(*sobol, out_.target + "_sobol_first_error");
    const std::vector<double>& total = map_of(*sobol, out_.target + "_sobol_total");
    for (std::size_t i = 0; i < out_.study.uncertain.parameters.size(); ++i) {
      const std::string& name = out_.study.uncertain.parameters[i].draws.name;
      RankedTolerance ranked = {name, first[i], error[i], total[i], std::nullopt};
      if (!tighten(here, *now, &ranked)) return false;
      out_.ranking.push_back(std::move(ranked));
    }
    std::ranges::stable_sort(out_.ranking, std::greater{}, &RankedTolerance::total);
    return true;
  }

 private:
  std::optional<SweepResult> run(const Study& study, const SweepOptions& sweep,
                                 const std::string& what) const {
    if (options_.on_step) options_.on_step(what);
    return run_sweep(study, sweep);
  }

  // An error falls with the square root of the gears.
  std::size_t gears_for_width() const {
    const Percentile& worst = out_.percentiles[out_.worst];
    if (!options_.width || !(worst.error > *options_.width * std::abs(worst.value))) return 0;
    constexpr double kFourTimes = 4.0;  // where the error is not known either
    const double more = std::isinf(worst.error)
                            ? kFourTimes
                            : std::pow(worst.error / (*options_.width * std::abs(worst.value)), 2);
    const double gears = std::ceil(1.1 * more * static_cast<double>(out_.gears()));
    return static_cast<std::size_t>(std::min(gears, static_cast<double>(kMostGears)));
  }

  // With the step of the run over all speeds.
  Study at_worst_speed() const {
    const Axis& speed = out_.study.axes.front();
    // Not more draws than what follows takes: each is worked out where a study is read.
    std::vector<std::string> overrides = {
        fmt::format("uncertain.samples={}", out_.tightened_gears)};
    if (out_.result.pilot) {
      const std::vector<std::string> of_step = out_.result.pilot->step.overrides();
      overrides.insert(overrides.end(), of_step.begin(), of_step.end());
    }
    const double value = speed.values[out_.worst];
    return changed(out_.study, overrides, {fmt::format("{}={}:{}:1", speed.name, value, value)});
  }

  // The percentile at the worst speed with the first draws of the study, changed so. Nothing when
  // stopped.
  std::optional<double> percentile_at(const Study& here, const std::vector<std::string>& overrides,
                                      const std::string& what) const {
    const std::optional<SweepResult> result =
        run(changed(here, overrides), options_.sweep_options(), what);
    if (!result) return std::nullopt;
    return percentile_with_error(draws_of_points(*result, out_.target).front(), options_.percentile)
        .value;
  }

  // The same draws, but for this parameter's, which lie half as far from its middle. now: the
  // percentile with the first draws as they are, on the same steps.
  bool tighten(const Study& here, double now, RankedTolerance* ranked) const {
    const std::string half = scaled_tolerance(here, ranked->name, 0.5);
    if (half.empty()) return true;
    const std::optional<double> then =
        percentile_at(here, {fmt::format("uncertain.{}={}", ranked->name, half)},
                      fmt::format("{} half as wide", ranked->name));
    if (!then) return false;
    ranked->tightened = out_.percentiles[out_.worst].value * (*then / now);
    return true;
  }

  const ToleranceOptions& options_;
  Scatter& out_;
};

}  // namespace

std::vector<std::vector<double>> draws_of_points(const SweepResult& result,
                                                 const std::string& quantity) {
  const std::vector<double>& all = map_of(result, quantity + "_draws");
  const std::size_t draws = result.study.uncertain.draws();
  std::vector<std::vector<double>> rows;
  for (std::size_t point = 0; point < result.study.points(); ++point) {
    const auto first = all.begin() + static_cast<std::ptrdiff_t>(point * draws);
    rows.emplace_back(first, first + static_cast<std::ptrdiff_t>(draws));
  }
  return rows;
}

Percentile percentile_with_error(std::vector<double> numbers, double percentile) {
  std::erase_if(numbers, [](double number) { return std::isnan(number); });
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  if (numbers.empty()) return {kNone, kNone};
  std::ranges::sort(numbers);
  const auto count = static_cast<double>(numbers.size());
  const double share = percentile / 100.0;
  const double ranks = kQuantile95 * std::sqrt(count * share * (1.0 - share));
  const auto at = [&](double rank) { return numbers[static_cast<std::size_t>(rank)]; };
  const double middle = share * (count - 1.0);
  const bool has_ends = middle - ranks >= 0.0 && middle + ranks <= count - 1.0;
  if (!has_ends) {
    return {percentile_of(numbers, percentile), std::numeric_limits<double>::infinity()};
  }
  return {percentile_of(numbers, percentile),
          0.5 * (at(std::ceil(middle + ranks)) - at(std::floor(middle - ranks)))};
}

ResultMap Scatter::map(const std::string& quantity) const {
  const std::vector<Quantity>& all = result.study.selection.quantities;
  const auto found = std::ranges::find(all, quantity, &Quantity::name);
  const Axis& speed = study.axes.front();
  ResultMap map;
  map.name = found->name;
  map.unit = found->unit;
  map.meaning = found->meaning;
  map.flags = found->flags;
  map.axes.push_back({speed.name, speed.unit, speed.meaning, speed.values, speed.logarithmic});
  map.values = map_of(result, quantity);
  if (study.scales.known()) convert_to_si(study.scales, &map);
  return map;
}

double Scatter::scale_of(const std::string& quantity) const {
  if (!study.scales.known()) return 1.0;
  const std::vector<Quantity>& all = result.study.selection.quantities;
  const SiUnit si =
      shown_unit(std::ranges::find(all, quantity, &Quantity::name)->unit, study.scales);
  return si.scale > 0.0 ? si.scale : 1.0;
}

std::optional<Scatter> find_scatter(const Study& study, const ToleranceOptions& options) {
  Scatter scatter;
  static_cast<AsBuilt&>(scatter) = as_built(study, options);
  find_speed_axis(study);
  overrides_of_draw(scatter.study, 0);  // throws, before it takes time, where there are none
  ScatterRuns runs(options, &scatter);
  if (!runs.run_gears()) return std::nullopt;
  judge_contact(&scatter);
  find_worst_gears(&scatter);
  if (!runs.rank()) return std::nullopt;
  return scatter;
}

}  // namespace gearsweep
