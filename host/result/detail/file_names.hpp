// What parameters and initial states are called in a file.
//
// They are called what the study calls them, but for those whose name something else in the file
// bears, such as a parameter `period` beside the quantity `period`: a parameter is parameter_NAME
// then, an initial state initial_NAME. Everything else always has its own name.
#pragma once

#include <string>
#include <vector>

#include "study/study.hpp"

namespace gearsweep {

// How many mesh periods a forcing period has: an attribute of results, a variable of traces.
inline constexpr const char* kMeshPeriods = "mesh_periods_per_period";
// A file of two meshes names the drawing of the one whose period is that of the phase, the other's,
// and how its frequency is to the first one's.
inline constexpr const char* kMeshOfPhase = "mesh_of_phase";
inline constexpr const char* kOtherMesh = "other_mesh";
inline constexpr const char* kOtherMeshOrder = "other_mesh_order";
inline constexpr const char* kClockless = "clockless";  // 1 in traces of a model without forcing
inline constexpr const char* kRole = "role";            // of a channel (model/role.hpp)
inline constexpr const char* kVelocity = "velocity";    // of a state, the state that is its rate

// The name of an axis or of a column of points, in the result file of its study.
std::string name_in_result(const Swept& swept, const Study& study);

// The name of a parameter, in a file of traces of these channels.
std::string name_in_traces(const std::string& parameter, const std::vector<ChannelInfo>& channels);

}  // namespace gearsweep
