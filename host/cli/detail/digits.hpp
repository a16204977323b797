// Numbers with the digits that hold and no others.
#pragma once

#include <string>

namespace gearsweep {

// `value`, known to within `error`, to a last digit of which the error is at most a half; at most
// ten digits. "?" when none holds.
std::string with_digits(double value, double error);

}  // namespace gearsweep
