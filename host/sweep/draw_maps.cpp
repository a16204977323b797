#include "sweep/draw_maps.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sweep/detail/map_value.hpp"
#include "sweep_types.h"

namespace gearsweep {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

std::vector<double> numbers_among(std::vector<double> values) {
  std::erase_if(values, [](double value) { return std::isnan(value); });
  return values;
}

// Mean and standard deviation (of a sample: divided by n - 1) of numbers of which there is one at
// least; of one the deviation is NaN.
struct MeanAndDeviation {
  double mean = 0.0, deviation = 0.0;
};

MeanAndDeviation spread_of(const std::vector<double>& numbers) {
  const auto count = static_cast<double>(numbers.size());
  MeanAndDeviation spread;
  for (const double number : numbers) spread.mean += number / count;
  double squares = 0.0;
  for (const double number : numbers) {
    squares += (number - spread.mean) * (number - spread.mean);
  }
  spread.deviation = numbers.size() > 1 ? std::sqrt(squares / (count - 1.0)) : kNone;
  return spread;
}

}  // namespace

double percentile_of(const std::vector<double>& sorted, double percentile) {
  const double place = percentile / 100.0 * static_cast<double>(sorted.size() - 1);
  const auto below = std::min(static_cast<std::size_t>(place), sorted.size() - 1);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  const double share = place - static_cast<double>(below);
  return sorted[below] + share * (sorted[above] - sorted[below]);
}

SobolIndices sobol_indices(const std::vector<double>& values, std::size_t samples,
                           std::size_t parameters) {
  const std::vector<double> both =
      numbers_among({values.begin(), values.begin() + static_cast<std::ptrdiff_t>(2 * samples)});
  SobolIndices indices;
  const MeanAndDeviation spread = both.empty() ? MeanAndDeviation{kNone, kNone} : spread_of(both);
  const double variance = spread.deviation * spread.deviation;
  for (std::size_t i = 0; i < parameters; ++i) {
    std::vector<double> first, total;
    for (std::size_t j = 0; j < samples; ++j) {
      const double a = values[j] - spread.mean, b = values[samples + j] - spread.mean;
      const double mixed = values[(2 + i) * samples + j] - spread.mean;
      if (std::isnan(a + b + mixed)) continue;
      first.push_back(b * (mixed - a));
      total.push_back(0.5 * (a - mixed) * (a - mixed));
    }
    const bool is_known = !first.empty() && variance > 0.0;
    const MeanAndDeviation of_first = is_known ? spread_of(first) : MeanAndDeviation{kNone, kNone};
    indices.first.push_back(of_first.mean / variance);
    indices.first_error.push_back(of_first.deviation / variance /
                                  std::sqrt(static_cast<double>(first.size())));
    indices.total.push_back(is_known ? spread_of(total).mean / variance : kNone);
  }
  return indices;
}

DrawMaps::DrawMaps(const Study& study) : study_(study), quantities_(draw_quantities(study)) {
  const std::vector<Quantity>& all = study_.selection.quantities;
  for (const DrawQuantity& quantity : quantities_) {
    if (!quantity.of_status && std::ranges::find(sources_, quantity.source) == sources_.end()) {
      sources_.push_back(quantity.source);
    }
    const auto target = std::ranges::find(all, quantity.quantity.name, &Quantity::name);
    targets_.push_back(static_cast<std::size_t>(target - all.begin()));
  }
  const std::size_t numbers = study_.points() * study_.uncertain.draws();
  kept_.assign(sources_.size(), std::vector<double>(numbers, kNone));
  is_ok_.assign(numbers, 0);
}

void DrawMaps::add(const Plan& plan, std::size_t trajectory, const TileResult& result,
                   std::size_t position) {
  if (!has_values(result.status[position])) return;
  const std::size_t point = trajectory % study_.points();
  const std::size_t draw = trajectory / study_.points() - 1;
  const std::size_t place = point * study_.uncertain.draws() + draw;
  is_ok_[place] = 1;
  for (std::size_t i = 0; i < sources_.size(); ++i) {
    const Quantity& quantity = study_.selection.quantities[sources_[i]];
    kept_[i][place] = map_value(plan, quantity, 0, trajectory, result, position);
  }
}

double DrawMaps::diverged_share(std::size_t point) const {
  const std::size_t draws = study_.uncertain.draws();
  const std::size_t independent = study_.uncertain.independent_draws();
  const auto begin = is_ok_.begin() + static_cast<std::ptrdiff_t>(point * draws);
  const auto diverged =
      std::count(begin, begin + static_cast<std::ptrdiff_t>(independent), std::uint8_t{0});
  return static_cast<double>(diverged) / static_cast<double>(independent);
}

void DrawMaps::reduce_source(std::size_t point, std::size_t source,
                             std::vector<std::vector<double>>* values) const {
  const Uncertain& uncertain = study_.uncertain;
  const std::size_t draws = uncertain.draws();
  const auto begin = kept_[source].begin() + static_cast<std::ptrdiff_t>(point * draws);
  const std::vector<double> all(begin, begin + static_cast<std::ptrdiff_t>(draws));
  const std::vector<double> independent(
      all.begin(), all.begin() + static_cast<std::ptrdiff_t>(uncertain.independent_draws()));
  std::vector<double> sorted = numbers_among(independent);
  std::ranges::sort(sorted);
  const auto count = static_cast<double>(sorted.size());
  const MeanAndDeviation spread =
      sorted.empty() ? MeanAndDeviation{kNone, kNone} : spread_of(sorted);
  SobolIndices indices;
  if (uncertain.sobol) {
    indices = sobol_indices(all, uncertain.samples, uncertain.parameters.size());
  }
  const auto numbers_of = [&](const DrawQuantity& quantity) -> std::vector<double> {
    switch (quantity.statistic) {
      case DrawStatistic::mean:
        return {spread.mean};
      case DrawStatistic::standard_deviation:
        return {spread.deviation};
      case DrawStatistic::percentile:
        return {sorted.empty() ? kNone : percentile_of(sorted, quantity.percentile)};
      case DrawStatistic::share:
        return {
            static_cast<double>(std::ranges::count(sorted, static_cast<double>(quantity.flag))) /
            count};
      case DrawStatistic::sobol_first:
        return indices.first;
      case DrawStatistic::sobol_first_error:
        return indices.first_error;
      case DrawStatistic::sobol_total:
        return indices.total;
      case DrawStatistic::each_value:
        break;
    }
    return independent;
  };
  for (std::size_t i = 0; i < quantities_.size(); ++i) {
    const DrawQuantity& quantity = quantities_[i];
    if (quantity.of_status || quantity.source != sources_[source]) continue;
    const std::vector<double> numbers = numbers_of(quantity);
    std::ranges::copy(numbers, (*values)[targets_[i]].begin() +
                                   static_cast<std::ptrdiff_t>(point * numbers.size()));
  }
}

void DrawMaps::reduce(std::vector<std::vector<double>>* values) const {
  for (std::size_t point = 0; point < study_.points(); ++point) {
    for (std::size_t source = 0; source < sources_.size(); ++source) {
      reduce_source(point, source, values);
    }
    for (std::size_t i = 0; i < quantities_.size(); ++i) {
      if (quantities_[i].of_status) (*values)[targets_[i]][point] = diverged_share(point);
    }
  }
}

}  // namespace gearsweep
