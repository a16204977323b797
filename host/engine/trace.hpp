// The time history of one point.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "model/model.hpp"

namespace gearsweep {

constexpr const char* kEvents = "at_surface";

struct Trace {
  ModelSetting setting;       // of the point
  double period = 0.0;        // of the forcing, in dimensionless time
  bool is_clockless = false;  // there is no forcing: a period is a count of time alone
  double mesh_periods = 1.0;  // in one period
  std::size_t settled = 0;    // periods before the first moment
  std::vector<double> tau;    // [moment] dimensionless time since the first
  // The model's states, its signals, and, of a model with backlash, `contact`: 1 on the drive
  // flank, 0 in the gap, -1 on the back flank, 2 on both (wedged). Of a model with surfaces also
  // kEvents: the number of the surface that the motion comes to, counted from 1 on, of one where
  // the state is not reset with a minus; 0: of none. The same moment stands twice there, with the
  // values before and behind it. Evenly spaced moments have the number where the surface was met
  // since the moment before.
  std::vector<ChannelInfo> channels;
  std::vector<std::vector<double>> values;  // [channel][moment]
};

}  // namespace gearsweep
