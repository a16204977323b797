#include "engine/result.hpp"

#include <algorithm>
#include <stdexcept>

#include "model/array.hpp"

namespace gearsweep {

const std::vector<double>& map_of(const SweepResult& result, const std::string& quantity) {
  const std::vector<Quantity>& quantities = result.study.selection.quantities;
  const auto found = std::find_if(quantities.begin(), quantities.end(),
                                  [&](const Quantity& q) { return q.name == quantity; });
  if (found == quantities.end()) throw std::logic_error("the study has no " + quantity);
  return result.values[static_cast<std::size_t>(found - quantities.begin())];
}

std::vector<double> samples_of(const SweepResult& result, std::size_t point, std::size_t chosen) {
  const Array3 samples(result.samples, result.study.selection.poincare.size(),
                       result.study.integrate.record);
  const std::span<const double> own = samples[point][chosen];
  return {own.begin(), own.end()};
}

}  // namespace gearsweep
