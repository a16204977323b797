// One number beside what it must be.
#pragma once

#include <string>

namespace gearsweep {

struct Compared {
  std::string what;  // "x1_rms at omega = 0.7"
  double expected = 0.0, seen = 0.0;
  double tolerance = 0.0;  // of their difference; 0: the same number, or both not a number

  bool holds() const;
  // The difference in tolerances; infinite when it does not hold and has no tolerance.
  double share_of_tolerance() const;
};

// "x1_rms: expected 1.25, seen 1.26 (tolerance 1e-07)", with the digits that tell the numbers.
std::string describe(const Compared& compared);

}  // namespace gearsweep
