// Runs a study, given as such or as text.
#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "study/study.hpp"
#include "sweep/sweep.hpp"

namespace gearsweep::testing {

// The runs of a test program share what is opened and built: OpenCL's drivers read their library of
// functions anew for everybody who opens a device.
inline SweepResult run(const Study& study) {
  static const SweepOptions kShared;
  std::optional<SweepResult> result = run_sweep(study, kShared);
  if (!result) throw std::logic_error("the sweep was stopped, though nothing stops it here");
  return *std::move(result);
}

inline SweepResult run(const std::string& toml, const std::vector<std::string>& overrides = {}) {
  return run(read_study(toml, "test.toml", overrides));
}

}  // namespace gearsweep::testing
