// The maps of a finished sweep, in memory.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "study/found_step.hpp"
#include "study/study.hpp"
#include "sweep_types.h"

namespace gearsweep {

// What computed the maps; goes into the result file.
struct EngineInfo {
  std::string device;  // "pthread-skylake-avx512 (PoCL)"
  std::string driver;  // driver version
  std::string macros;  // the kernel's build options; empty for the reference engine
};

// One attractor of the list that `attractor` numbers, from 1.
struct Attractor {
  std::size_t motion = 0;  // class of motion_class, of most of its trajectories
  double period = 0.0;     // in forcing periods, of most of its trajectories; 0: none
  // Over its trajectories: mean rms of the model's first state, largest value of its
  // Model::contact_force() (NaN when it has none), mean lyapunov_max.
  double rms = 0.0, peak = 0.0, exponent = 0.0;
  std::size_t trajectories = 0;  // that reached it
  // Impacts of most of its trajectories, as n-m-k: in a motion of n forcing periods, m on the drive
  // flank and k on the back flank. Empty where there is no period or nobody asks for impacts.
  std::string impacts = {};
};

// How integrate.tolerance was met (sweep/pilot.hpp).
struct PilotFindings {
  FoundStep step;
  double error = 0.0;  // the largest of `errors`, samples of sections included
  // Share of all periodic points that keep the tolerance, at 95 % confidence: at least.
  double kept = 0.0;
  // Share of the pilot's points that were found to land elsewhere at any change of the step, and
  // how many of all may, at 95 % confidence.
  double sensitive = 0.0, max_sensitive = 0.0;
  std::size_t points = 0;  // periodic ones, that were compared
  // By quantity, of those that are compared: relative to the map's range, at 99 % of the points
  // that are not sensitive.
  std::map<std::string, double> errors;
};

// Whether a point that ended so has values, a code of kernels/sweep_types.h; otherwise it has NaN
// in every map.
inline bool has_values(std::uint8_t status) {
  return status != STATUS_diverged && status != STATUS_step_too_long;
}

// Point (ix, iy) has index iy * nx + ix.
struct SweepResult {
  Study study;
  EngineInfo engine;
  std::vector<std::uint8_t> status;  // [point], codes of kernels/sweep_types.h
  // [point] 1: its trajectory stopped on a periodic orbit; 0 as well for what a journal gave.
  std::vector<std::uint8_t> on_orbit;
  // [quantity of study.selection][point * its width + i]
  std::vector<std::vector<double>> values;
  std::vector<std::string> integrated;  // the states that were (plan/passive_states.hpp)
  std::optional<PilotFindings> pilot;   // of a study with a tolerance
  std::vector<Attractor> attractors;    // empty unless the study has a census
  std::size_t uncertain = 0;            // trajectories that may be of either of two attractors
  std::vector<double> samples;          // [point][chosen state][sample]; empty without poincare
  // Sums over all tiles, those of an interrupted run that this one continued included.
  double steps = 0.0;           // integration steps in all
  double seconds = 0.0;         // wall time of the computation
  double kernel_seconds = 0.0;  // of these in kernels; 0: the engine has none
  std::size_t stopped = 0;      // trajectories that settled on a periodic orbit and stopped there
};

// The map of a quantity that the study asks for, as SweepResult::values holds it. Throws
// std::logic_error when it does not ask for it.
const std::vector<double>& map_of(const SweepResult& result, const std::string& quantity);

// Poincare samples of one point: the `chosen`-th sampled state, one number per recorded period.
std::vector<double> samples_of(const SweepResult& result, std::size_t point, std::size_t chosen);

}  // namespace gearsweep
