// The integration steps of one forcing period, aligned with the model's break phases, and the phase
// coefficients at each stage.
#pragma once

#include <cstdint>
#include <vector>

#include "model/model.hpp"

namespace gearsweep {

// A segment is the part of the period between two break phases; its steps are equal. A segment of n
// steps has 2 n + 1 rows of coefficients: at the steps' ends and middles, one-sided at its own
// ends.
struct PhaseGrid {
  std::vector<std::uint32_t> segment_steps;  // steps of each segment
  std::vector<double> segment_fractions;     // length of each step, as a share of the period
  std::vector<double> coefs;                 // [row][phase coefficient]
  std::size_t steps = 0;                     // of the whole period
};

// Break phases, sorted, distinct, from 0 to 1 (both included).
std::vector<double> segment_bounds(const Model& model, const ModelSetting& setting);

// At least `steps` steps in all, each segment a whole number of them. bounds: segment_bounds() of a
// setting that differs in nothing that shapes the phase.
PhaseGrid make_phase_grid(const Model& model, const ModelSetting& setting, std::size_t steps,
                          const std::vector<double>& bounds);
PhaseGrid make_phase_grid(const Model& model, const ModelSetting& setting, std::size_t steps);

// The smallest number of the ladder 16, 20, 24, 28, 32, 40, 48, ... (four per octave) that is at
// least `wanted`, so that neighbouring points share a phase grid.
std::size_t ladder_steps(double wanted);

// The same of a ladder that begins with 1, for a model without forcing: its period is a clock that
// asks for no steps of its own.
std::size_t few_steps(double wanted);

}  // namespace gearsweep
