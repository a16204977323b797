#include "figures.hpp"

#include <algorithm>

namespace gearsweep::bench {
namespace {

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

void Figures::report(benchmark::State& state) const {
  for (const auto& [name, values] : found_) {
    state.counters[name] = benchmark::Counter(median(values), benchmark::Counter::kDefaults,
                                              benchmark::Counter::OneK::kIs1000);
  }
}

}  // namespace gearsweep::bench
