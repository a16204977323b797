#include "explore/diagram.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "sweep/sweep.hpp"
#include "sweep_types.h"

namespace gearsweep {
namespace {

// More are not told apart in a column of pixels.
constexpr std::size_t kMaxSamples = 64;

std::vector<double> values_on(const Scene& scene, const Line& line, const Strip& strip) {
  std::vector<double> values;
  for (std::uint64_t j = 0; j < Strip::kCells; ++j) {
    const std::uint64_t k = strip.depth == 0 ? j : 2 * (Strip::kCells * strip.at + j) + 1;
    values.push_back(scene.value_at(line.axis, k, strip.depth + 7));
  }
  return values;
}

// Of a motion that rests, and comes to no section: where it rests.
std::vector<double> samples_at(const SweepResult& result, std::size_t cell, std::size_t state) {
  const Model& model = *result.study.model;
  if (model.is_clockless && map_of(result, "motion_class")[cell] == double{MOTION_equilibrium}) {
    return {map_of(result, model.states[state].name + "_mean")[cell]};
  }
  return samples_of(result, cell, state);
}

// The last ones that there are: a motion comes to a section less often than a record may hold.
void append_last(const std::vector<double>& samples, std::size_t count,
                 std::vector<double>* numbers) {
  const auto last = std::find_if(samples.rbegin(), samples.rend(), [](double value) {
                      return !std::isnan(value);
                    }).base();
  const auto there = std::min(static_cast<std::ptrdiff_t>(count), last - samples.begin());
  numbers->insert(numbers->end(), last - there, last);
  numbers->insert(numbers->end(), count - static_cast<std::size_t>(there),
                  std::numeric_limits<double>::quiet_NaN());
}

}  // namespace

std::optional<StripMaps> compute_strip(const Scene& scene, const Line& line, const Strip& strip,
                                       const SweepOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  std::array<std::vector<double>, 2> values;
  values[line.axis] = values_on(scene, line, strip);
  values[1 - line.axis] = {scene.value_at(1 - line.axis, line.k, line.depth)};
  const std::optional<SweepResult> result = run_sweep(scene.sampled_at(values), options);
  if (!result) return std::nullopt;
  StripMaps maps;
  maps.samples = std::min(result->study.integrate.record, kMaxSamples);
  maps.numbers.assign(result->status.begin(), result->status.end());
  for (std::size_t i = 0; i < scene.study().selection.quantities.size(); ++i) {
    const std::vector<double>& map = result->values[i];
    maps.numbers.insert(maps.numbers.end(), map.begin(), map.end());
  }
  for (std::size_t state = 0; state < result->study.selection.poincare.size(); ++state) {
    for (std::size_t cell = 0; cell < Strip::kCells; ++cell) {
      append_last(samples_at(*result, cell, state), maps.samples, &maps.numbers);
    }
  }
  maps.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return maps;
}

}  // namespace gearsweep
