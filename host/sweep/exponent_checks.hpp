// Two answers that a map of Lyapunov spectra has to give, whatever the motion.
#pragma once

#include <cstddef>
#include <optional>

#include "engine/result.hpp"

namespace gearsweep {

// The exponents sum to the mean divergence of the field along the motion.
struct SumCheck {
  double off = 0.0;         // the largest difference at any point, in inverse time
  double divergence = 0.0;  // there
  double largest = 0.0;     // modulus of an exponent there
  // Whether the difference is more than a thousandth of the numbers that are summed.
  bool is_far_off() const;
};

// Along an autonomous motion that does not rest a shift in time neither grows nor decays: one
// exponent is 0 (H. Haken, Phys. Lett. A 94, 1983). Over a time T that exponent is the logarithm of
// the speed at its end over that at its beginning, by T.
struct ZeroCheck {
  std::size_t judged = 0;   // points with a positive exponent
  std::size_t lacking = 0;  // of these, without one within 10/T of 0, T being the time of record
};

struct ExponentChecks {
  std::size_t points = 0;         // with a spectrum
  std::optional<SumCheck> sum;    // nothing where the divergence differs from state to state
  std::optional<ZeroCheck> zero;  // nothing for forced models
};

// Nothing where the study has no spectra.
std::optional<ExponentChecks> check_exponents(const SweepResult& result);

}  // namespace gearsweep
