// The kernel program of a study: sources put together from the embedded kernels/, and built.
#pragma once

#include <map>
#include <string>

#include "opencl/detail/cl.hpp"
#include "opencl/program_source.hpp"

namespace gearsweep {

// The text of selection.h (see kernels/items.h): the model, its options, how many tangent vectors
// there are. It does not depend on the study's axes.
std::string selection_header(const Study& study);

// One text from `name` and all that it includes, each file once, marked by #line so that messages
// of the device compiler name it. `sources` by path. Throws RunError for a missing file.
std::string flatten(const std::string& name, const std::map<std::string, std::string>& sources);

// Throws RunError with device, options and the device compiler's log.
cl::Program build_program(const cl::Context& context, const cl::Device& device,
                          const std::string& source, const std::string& options);

}  // namespace gearsweep
