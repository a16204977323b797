// The message of a check, with expressions in it.
#pragma once

#include <string>
#include <vector>

namespace gearsweep {

// "cycle must be a multiple of its {zp} teeth": the texts around the expressions, one more than
// these.
struct CheckMessage {
  std::vector<std::string> texts, values;
};

CheckMessage split_message(const std::string& message);

// With the values in their places.
std::string filled(const CheckMessage& message, const double* values);

}  // namespace gearsweep
