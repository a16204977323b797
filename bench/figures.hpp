// Numbers that each iteration of a benchmark finds; its counters are their medians.
#pragma once

#include <benchmark/benchmark.h>

#include <map>
#include <string>
#include <vector>

namespace gearsweep::bench {

class Figures {
 public:
  void add(const std::string& name, double value) { found_[name].push_back(value); }
  void report(benchmark::State& state) const;

 private:
  std::map<std::string, std::vector<double>> found_;
};

}  // namespace gearsweep::bench
