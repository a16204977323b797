#include "explore/diagram.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "explore/cell_maps.hpp"
#include "explore/detail/pieces.hpp"
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

// A motion that rests comes to no section: its sample is where it rests.
std::vector<double> samples_at(const SweepResult& result, std::size_t cell, std::size_t state) {
  const Model& model = *result.study.model;
  if (model.is_clockless && map_of(result, "motion_class")[cell] == double{MOTION_equilibrium}) {
    return {map_of(result, model.states[state].name + "_mean")[cell]};
  }
  return samples_of(result, cell, state);
}

// The maps and samples of a strip, filled by parts of its cells.
class StripFilling {
 public:
  StripFilling(const Scene& scene, const Line& line, const Strip& strip,
               const SweepOptions& options)
      : scene_(scene),
        line_(line),
        options_(options),
        values_(values_on(scene, line, strip)),
        maps_(1 + scene.study().selection.quantities.size()),
        states_(scene.study().model->states.size()) {
    out_.samples = std::min(scene.study().integrate.record, kMaxSamples);
    out_.numbers.assign(Strip::kCells * (maps_ + states_ * out_.samples),
                        std::numeric_limits<double>::quiet_NaN());
  }

  // False when stopped.
  bool compute(const std::vector<std::size_t>& cells) {
    std::array<std::vector<double>, 2> values;
    for (const std::size_t cell : cells) values[line_.axis].push_back(values_[cell]);
    values[1 - line_.axis] = {scene_.value_at(1 - line_.axis, line_.k, line_.depth)};
    const std::optional<SweepResult> result = run_sweep(scene_.sampled_at(values), options_);
    if (!result) return false;
    for (std::size_t point = 0; point < cells.size(); ++point) {
      at(0, cells[point]) = result->status[point];
      for (std::size_t map = 1; map < maps_; ++map) {
        at(map, cells[point]) = result->values[map - 1][point];
      }
      for (std::size_t state = 0; state < states_; ++state) {
        put_last(samples_at(*result, point, state), cells[point], state);
      }
    }
    return true;
  }

  void refuse(const std::vector<std::size_t>& cells) {
    for (const std::size_t cell : cells) at(0, cell) = kRefused;
  }

  StripMaps take(double seconds) {
    out_.seconds = seconds;
    return std::move(out_);
  }

 private:
  double& at(std::size_t map, std::size_t cell) { return out_.numbers[map * Strip::kCells + cell]; }

  // The last ones that there are: a motion comes to a section less often than a record may hold.
  void put_last(const std::vector<double>& samples, std::size_t cell, std::size_t state) {
    const auto last = std::find_if(samples.rbegin(), samples.rend(), [](double value) {
                        return !std::isnan(value);
                      }).base();
    const auto there = std::min(static_cast<std::ptrdiff_t>(out_.samples), last - samples.begin());
    const std::size_t first = Strip::kCells * maps_ + (state * Strip::kCells + cell) * out_.samples;
    std::copy(last - there, last, out_.numbers.begin() + static_cast<std::ptrdiff_t>(first));
  }

  const Scene& scene_;
  const Line line_;
  const SweepOptions& options_;
  const std::vector<double> values_;
  const std::size_t maps_, states_;
  StripMaps out_;
};

}  // namespace

std::optional<StripMaps> compute_strip(const Scene& scene, const Line& line, const Strip& strip,
                                       const SweepOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  StripFilling filling(scene, line, strip, options);
  CellGrid cells = {{{}, {0}}};
  for (std::size_t cell = 0; cell < Strip::kCells; ++cell) cells[0].push_back(cell);
  const bool is_done = compute_in_pieces(
      cells, [&](const CellGrid& part) { return filling.compute(part[0]); },
      [&](const CellGrid& part, const std::string&) { filling.refuse(part[0]); });
  if (!is_done) return std::nullopt;
  return filling.take(
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
}

}  // namespace gearsweep
