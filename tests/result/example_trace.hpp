// A trace made by hand for the tests of this folder.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/trace.hpp"
#include "study/study.hpp"

namespace gearsweep::testing {

// The trace of a gear, so many moments to the period: x1 = sin, v1 = cos of 2 pi time, in contact
// on the drive flank where x1 is above 0.1.
inline Trace made_trace(const Study& study, std::size_t periods, std::size_t per_period) {
  Trace trace;
  trace.setting = study.setting;
  trace.period = 2.5;
  trace.channels = {{"x1", "b_n", "a position"},
                    {"v1", "b_n varpi", "velocity of x1"},
                    {"dmf", "k0 b_n", "a force", Role::mesh_force},
                    {"contact", "1", "flank"}};
  trace.values.resize(4);
  for (std::size_t i = 0; i < periods * per_period; ++i) {
    const double time = static_cast<double>(i) / static_cast<double>(per_period);
    const double sine = std::sin(2.0 * std::numbers::pi * time);
    trace.tau.push_back(trace.period * time);
    trace.values[0].push_back(sine);
    trace.values[1].push_back(std::cos(2.0 * std::numbers::pi * time));
    trace.values[2].push_back(std::max(sine, 0.0));
    trace.values[3].push_back(sine > 0.1 ? 1.0 : 0.0);
  }
  return trace;
}

}  // namespace gearsweep::testing
