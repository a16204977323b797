// Two answers that a map of Lyapunov spectra has to give, whatever the motion.
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "engine/result.hpp"

namespace gearsweep {

struct ExponentChecks {
  std::size_t points = 0;  // with a spectrum
  // The exponents sum to the mean divergence of the field along the motion. The largest difference
  // at any point, in inverse time, and the divergence there; nothing where the divergence differs
  // from state to state.
  struct Sum {
    double off = 0.0, divergence = 0.0;
  };
  std::optional<Sum> sum;
  // Along an autonomous motion that does not rest a shift in time neither grows nor decays: one
  // exponent is 0 (H. Haken, Phys. Lett. A 94, 1983). Of the points with a positive exponent, those
  // that have none within 10/T of 0, T being the time of record: over T that exponent is the
  // logarithm of the speed at its end over that at its beginning, by T. Nothing for forced models.
  struct Zero {
    std::size_t judged = 0, lacking = 0;
  };
  std::optional<Zero> zero;
};

// Nothing where the study has no spectra.
std::optional<ExponentChecks> check_exponents(const SweepResult& result);

// A line for each check; empty without spectra.
std::string describe_exponent_checks(const SweepResult& result);
// Null without spectra.
nlohmann::json exponent_checks_as_json(const SweepResult& result);

}  // namespace gearsweep
