// The motion at one point of a scene.
#pragma once

#include <complex>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/trace.hpp"
#include "explore/scene.hpp"
#include "point/place.hpp"
#include "sweep/sweep_options.hpp"

namespace gearsweep {

struct MotionSpectrum {
  double order_step = 0.0;
  std::vector<std::vector<double>> amplitude;  // [channel of the trace][bin]
};

struct MotionOrbit {
  std::vector<std::complex<double>> multipliers;
  std::size_t period = 0;  // in forcing periods or returns
  bool is_equilibrium = false, is_stable = false;
};

struct Motion {
  Study study;                 // of the point alone
  std::vector<NamedValue> at;  // the axes' values
  std::uint8_t status = 0;     // as a map has it
  std::vector<double> values;  // of each quantity of the study, what a run gives there
  std::optional<Trace> trace;  // nothing of one that diverged
  std::size_t samples_per_period = 0;
  std::optional<MotionSpectrum> spectrum;
  bool is_on_orbit = false;  // it came to a periodic orbit, of which find_motion_orbit() tells
  std::vector<std::string> notes;  // what could not be told, and why
};

// Without its spectrum. Throws InputError for what the study refuses, RunError when no device
// works.
Motion find_motion(const Scene& scene, const Cell& cell, const SweepOptions& options);

// Adds the spectrum of its trace. No two threads may be at it at once: FFTW's planner cannot be.
void add_spectrum(Motion* motion);

// The orbit that Newton's method finds from that motion. Throws as find_motion(), and RunError
// where there is none.
MotionOrbit find_motion_orbit(const Scene& scene, const Cell& cell, const SweepOptions& options);

}  // namespace gearsweep
