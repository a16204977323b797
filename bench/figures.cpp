#include "figures.hpp"

#include "measure/samples.hpp"

namespace gearsweep::bench {
void Figures::report(benchmark::State& state) const {
  for (const auto& [name, values] : found_) {
    state.counters[name] = benchmark::Counter(median(values), benchmark::Counter::kDefaults,
                                              benchmark::Counter::OneK::kIs1000);
  }
}

}  // namespace gearsweep::bench
