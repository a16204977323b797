// Lyapunov exponents of textbook systems: J. C. Sprott, Chaos and Time-Series Analysis (2003),
// appendix A (natural logarithm; the phase's zero exponent is not counted). The tolerances are
// those of the description of the models, section "Published answers".
#pragma once

#include <cstddef>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

namespace gearsweep::testing {

struct PublishedExponents {
  std::string name, model, preset;
  // The published start: many starts from `first` on, in steps of a thousandth, share the rest.
  double first;
  std::string state;              // the other states
  std::vector<double> exponents;  // the largest alone when the others are not published
  double tolerance;
  std::optional<double> sum;     // of all exponents, exact: the mean of the field's divergence
  std::size_t steps_per_period;  // of 0.01 to 0.06 units of time
  std::size_t record;            // periods of each start
};

inline void PrintTo(const PublishedExponents& row, std::ostream* out) { *out << row.name; }

// With 64 starts, `record` makes the standard error of the mean a fifth of the tolerance or less.
inline const std::vector<PublishedExponents>& published_exponents() {
  static const std::vector<PublishedExponents> rows = {
      {"lorenz",
       "lorenz",
       "classic",
       0.0,
       "y = -0.01, z = 9.0",
       {0.9056, 0.0, -14.5723},
       0.003,
       -41.0 / 3.0,
       100,
       2000},
      {"rossler",
       "rossler",
       "classic",
       -9.0,
       "",
       {0.0714, 0.0, -5.3943},
       0.0015,
       std::nullopt,
       40,
       4000},
      {"ueda", "duffing", "ueda", 2.5, "", {0.1034, -0.1534}, 0.003, -0.05, 160, 1000},
      {"two_well", "duffing", "two_well", 0.2, "", {0.1572, -0.4072}, 0.004, -0.25, 128, 1000},
      {"pendulum", "pendulum", "sprott", 0.0, "", {0.1414, -0.1914}, 0.005, -0.05, 160, 1000},
      {"vanderpol", "vanderpol", "sprott", -1.9, "", {0.1933}, 0.005, std::nullopt, 256, 1000},
      {"jerk", "jerk", "classic", 0.0, "v = -0.7", {0.0362, 0.0, -0.6362}, 0.003, -0.6, 20, 4000},
  };
  return rows;
}

}  // namespace gearsweep::testing
