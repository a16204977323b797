// The kernel programs of a study as text: what a device's compiler is given.
#pragma once

#include <cstddef>
#include <string>

#include "study/study.hpp"

namespace gearsweep {

// The whole text of the program `file` of kernels/ (sweep.cl, orbit.cl, trace.cl), generated parts
// and all that it includes, each file once.
std::string program_source(const Study& study, const std::string& file);

// What the device compiler is told, for so many points per work-item. A device that can round the
// division of fp32 correctly is asked to, so that devices give the same bits.
std::string build_options(const Study& study, std::size_t lanes, bool rounds_fp32_division = false);

}  // namespace gearsweep
