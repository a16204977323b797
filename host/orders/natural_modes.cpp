#include "orders/natural_modes.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <memory>

#include "model/eigenvalues.hpp"
#include "plan/phase_grid.hpp"

namespace gearsweep {
namespace {

// Column-major, averaged by Gauss's rule of two points on parts of the segments: exact where the
// stiffness is a cubic in the phase.
std::vector<double> mean_jacobian(const Model& model, const ModelSetting& setting) {
  constexpr double kPartsOfPeriod = 64.0;
  const double gauss = 0.5 / std::sqrt(3.0);
  const std::size_t states = model.states.size();
  const std::vector<double> equilibrium = model.equilibrium(setting);
  const std::unique_ptr<PreparedPoint> point = model.prepare(setting);
  const std::vector<double> bounds = segment_bounds(model, setting);
  const Model::PhaseRow row_at = model.phase_rows(setting);
  std::vector<double> coefs(model.phase_coefs.size()), rows(states * states);
  std::vector<double> mean(states * states, 0.0);
  for (std::size_t segment = 0; segment + 1 < bounds.size(); ++segment) {
    const double length = bounds[segment + 1] - bounds[segment];
    const double inside = bounds[segment] + 0.5 * length;
    const double parts = std::max(1.0, std::ceil(kPartsOfPeriod * length));
    for (double part = 0.0; part < parts; part += 1.0) {
      for (const double place : {0.5 - gauss, 0.5 + gauss}) {
        const double phase = bounds[segment] + (part + place) * length / parts;
        row_at(phase, inside, coefs.data());
        point->jacobian(coefs.data(), equilibrium.data(), rows.data());
        for (std::size_t i = 0; i < rows.size(); ++i) {
          mean[i % states * states + i / states] += 0.5 * length / parts * rows[i];
        }
      }
    }
  }
  return mean;
}

}  // namespace

std::vector<NaturalMode> natural_modes(const Model& model, const ModelSetting& setting) {
  const std::vector<double> jacobian = mean_jacobian(model, setting);
  const auto is_finite = [](double number) { return std::isfinite(number); };
  if (!std::all_of(jacobian.begin(), jacobian.end(), is_finite)) return {};
  std::vector<NaturalMode> modes;
  for (const std::complex<double>& value : eigenvalues(jacobian.data(), model.states.size())) {
    if (value.imag() <= 0.0) continue;
    modes.push_back({std::abs(value), -value.real() / std::abs(value)});
  }
  std::sort(modes.begin(), modes.end(),
            [](const NaturalMode& a, const NaturalMode& b) { return a.frequency < b.frequency; });
  return modes;
}

}  // namespace gearsweep
