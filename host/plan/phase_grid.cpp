#include "plan/phase_grid.hpp"

#include <algorithm>
#include <cmath>

namespace gearsweep {
namespace {

// Break phases closer than this are one: no step of that length would be of use.
constexpr double kSamePhase = 1e-9;

}  // namespace

std::vector<double> segment_bounds(const Model& model, const ModelSetting& setting) {
  std::vector<double> breaks = model.break_phases(setting);
  breaks.push_back(0.0);
  std::sort(breaks.begin(), breaks.end());
  std::vector<double> bounds;
  for (const double phase : breaks) {
    if (phase < 1.0 - kSamePhase && (bounds.empty() || phase > bounds.back() + kSamePhase)) {
      bounds.push_back(phase);
    }
  }
  bounds.push_back(1.0);
  return bounds;
}

PhaseGrid make_phase_grid(const Model& model, const ModelSetting& setting, std::size_t steps,
                          const std::vector<double>& bounds) {
  PhaseGrid grid;
  std::vector<PhasePlace> places;
  for (std::size_t segment = 0; segment + 1 < bounds.size(); ++segment) {
    const double from = bounds[segment];
    const double length = bounds[segment + 1] - from;
    // The tiny subtrahend keeps rounding from adding a step to a length that is a whole number.
    const double wanted = std::ceil(length * static_cast<double>(steps) - 1e-6);
    const auto count = static_cast<std::uint32_t>(std::max(1.0, wanted));
    grid.segment_steps.push_back(count);
    grid.segment_fractions.push_back(length / count);
    grid.steps += count;
    for (std::uint32_t row = 0; row <= 2 * count; ++row) {
      const double psi =
          row == 2 * count ? bounds[segment + 1] : from + length * row / (2.0 * count);
      places.push_back({psi, from + 0.5 * length});
    }
  }
  grid.coefs.resize(places.size() * model.phase_coefs.size());
  model.phase_table(setting, places, grid.coefs.data());
  return grid;
}

PhaseGrid make_phase_grid(const Model& model, const ModelSetting& setting, std::size_t steps) {
  return make_phase_grid(model, setting, steps, segment_bounds(model, setting));
}

namespace {

// Four numbers an octave, from `octave` on.
std::size_t ladder_from(std::size_t octave, double wanted) {
  while (static_cast<double>(2 * octave) < wanted) octave *= 2;
  for (std::size_t quarter = 0; quarter < 4; ++quarter) {
    const std::size_t steps = octave + quarter * (octave / 4);
    if (static_cast<double>(steps) >= wanted) return steps;
  }
  return 2 * octave;
}

}  // namespace

std::size_t ladder_steps(double wanted) { return ladder_from(16, wanted); }

std::size_t few_steps(double wanted) {
  if (wanted <= 4.0) return static_cast<std::size_t>(std::max(1.0, std::ceil(wanted)));
  return ladder_from(4, wanted);
}

}  // namespace gearsweep
