// Runs a study given as text, and reads its maps by name.
#pragma once

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include "distribute/sweep.hpp"
#include "study/study.hpp"

namespace gearsweep::testing {

inline SweepResult run(const std::string& toml, const std::vector<std::string>& overrides = {}) {
  std::optional<SweepResult> result = run_sweep(read_study(toml, "test.toml", overrides), {});
  if (!result) throw std::logic_error("the sweep was stopped, though nothing stops it here");
  return *std::move(result);
}

// The map of a quantity, [point].
inline const std::vector<double>& map_of(const SweepResult& result, const std::string& quantity) {
  const std::vector<Quantity>& quantities = result.study.selection.quantities;
  const auto found = std::find_if(quantities.begin(), quantities.end(),
                                  [&](const Quantity& q) { return q.name == quantity; });
  if (found == quantities.end()) throw std::logic_error("the study has no " + quantity);
  return result.values[static_cast<std::size_t>(found - quantities.begin())];
}

// Poincare samples of one point: the `chosen`-th sampled state, one number per recorded period.
inline std::vector<double> samples_of(const SweepResult& result, std::size_t point,
                                      std::size_t chosen) {
  const std::size_t record = result.study.integrate.record;
  const std::size_t first = (point * result.study.selection.poincare.size() + chosen) * record;
  const auto begin = result.samples.begin() + static_cast<std::ptrdiff_t>(first);
  return {begin, begin + static_cast<std::ptrdiff_t>(record)};
}

}  // namespace gearsweep::testing
