// Runs a study given as text.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "study/study.hpp"
#include "sweep/sweep.hpp"

namespace gearsweep::testing {

inline SweepResult run(const std::string& toml, const std::vector<std::string>& overrides = {}) {
  std::optional<SweepResult> result = run_sweep(read_study(toml, "test.toml", overrides), {});
  if (!result) throw std::logic_error("the sweep was stopped, though nothing stops it here");
  return *std::move(result);
}

}  // namespace gearsweep::testing
