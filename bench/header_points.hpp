// Points of a plan of gear5 for the header that is written by hand, which other integrators step.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "equations/headers.hpp"
#include "plan/plan.hpp"

namespace gearsweep::bench {

inline const Model& gear5_header() {
  return *std::ranges::find(handwritten_models(), "gear5", &Model::name);
}

inline ModelSetting header_setting(const Plan& plan, std::size_t point) {
  return translated(*plan.study().model, plan.setting_of(point), gear5_header());
}

// The header's coefficients at the rows of a grid.
inline std::vector<double> header_coefs(const PhaseGrid& grid, const ModelSetting& setting) {
  const Model& model = gear5_header();
  const std::size_t width = model.phase_coefs.size();
  std::vector<double> coefs;
  double from = 0.0;
  for (std::size_t segment = 0; segment < grid.segment_steps.size(); ++segment) {
    const std::uint32_t count = grid.segment_steps[segment];
    const double length = grid.segment_fractions[segment] * count;
    for (std::uint32_t row = 0; row <= 2 * count; ++row) {
      coefs.resize(coefs.size() + width);
      model.phase_coefs_at(setting, from + length * row / (2.0 * count), from + 0.5 * length,
                           coefs.data() + (coefs.size() - width));
    }
    from += length;
  }
  return coefs;
}

}  // namespace gearsweep::bench
