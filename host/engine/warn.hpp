// How a run tells of a failure that does not end it.
#pragma once

#include <functional>
#include <string>

namespace gearsweep {

// Told, in words for the user, of what has failed while the rest goes on.
using Warn = std::function<void(const std::string&)>;

}  // namespace gearsweep
