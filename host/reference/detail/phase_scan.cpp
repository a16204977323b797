#include "reference/detail/phase_scan.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace gearsweep {
namespace {

constexpr double kPhases = 2000.0;     // compared in a period of the forcing, at least
constexpr double kMeshPhases = 100.0;  // in one of the mesh
constexpr double kMaxPhases = 200000.0;
constexpr double kSame = 1e-7;  // phases that are one

std::size_t phases_of(double mesh_periods) {
  return static_cast<std::size_t>(std::clamp(kMeshPhases * mesh_periods, kPhases, kMaxPhases));
}

// Coefficients at phases of one setting.
class Scan {
 public:
  Scan(const Model& model, const ModelSetting& setting)
      : phases_(phases_of(model.mesh_periods(setting))),
        row_at_(model.phase_rows(setting)),
        here_(model.phase_coefs.size()),
        continued_(model.phase_coefs.size()) {}

  std::vector<double> breaks() {
    std::vector<double> found;
    for (std::size_t i = 0; i + 1 < phases_; ++i) {
      const double from = phase(i), to = phase(i + 1);
      if (!goes_on(from, to)) found.push_back(place(from, to));
    }
    return found;
  }

 private:
  // At no simple fraction of a period, where breaks may be.
  double phase(std::size_t i) const {
    return (static_cast<double>(i) + 0.382) / static_cast<double>(phases_);
  }

  // Whether the coefficients at `to` are those that the choices made at `from` give there.
  bool goes_on(double from, double to) {
    row_at_(to, to, here_.data());
    row_at_(to, from, continued_.data());
    return std::ranges::equal(here_, continued_, [](double one, double other) {
      constexpr double kRounding = 1e-9;
      const double size = std::max(std::fabs(one), std::fabs(other));
      if (std::isnan(one) || std::isnan(other)) return std::isnan(one) == std::isnan(other);
      return one == other || std::fabs(one - other) <= kRounding * size;
    });
  }

  double place(double from, double to) {
    const double begin = from;
    for (int i = 0; i < 45; ++i) {
      const double middle = 0.5 * (from + to);
      (goes_on(begin, middle) ? from : to) = middle;
    }
    return to;
  }

  const std::size_t phases_;
  const Model::PhaseRow row_at_;
  std::vector<double> here_, continued_;
};

bool is_among(double phase, const std::vector<double>& bounds) {
  return std::ranges::any_of(bounds,
                             [&](double bound) { return std::fabs(phase - bound) < kSame; });
}

}  // namespace

PhaseGrid scanned_phase_grid(const Model& model, const ModelSetting& setting, std::size_t steps) {
  const std::vector<double> bounds = segment_bounds(model, setting);
  std::vector<double> missed = Scan(model, setting).breaks();
  std::erase_if(missed, [&](double phase) { return is_among(phase, bounds); });
  if (missed.empty()) return make_phase_grid(model, setting, steps);
  Model seen = model;
  seen.break_phases = [&](const ModelSetting&) {
    std::vector<double> all = bounds;
    all.insert(all.end(), missed.begin(), missed.end());
    return all;
  };
  return make_phase_grid(seen, setting, steps);
}

}  // namespace gearsweep
