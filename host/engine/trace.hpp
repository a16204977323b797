// The time history of one point.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "model/model.hpp"

namespace gearsweep {

struct Trace {
  ModelSetting setting;       // of the point
  double period = 0.0;        // of the forcing, in dimensionless time
  double mesh_periods = 1.0;  // in one period
  std::size_t settled = 0;    // periods before the first moment
  std::vector<double> tau;    // [moment] dimensionless time since the first
  // The model's states, its signals, and, of a model with backlash, `contact`: 1 on the drive
  // flank, 0 in the gap, -1 on the back flank, 2 on both (wedged).
  std::vector<ChannelInfo> channels;
  std::vector<std::vector<double>> values;  // [channel][moment]
};

}  // namespace gearsweep
