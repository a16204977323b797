// The main of the benchmark programs. Beside Google Benchmark's own flags it knows
//   --all        all benchmarks, the long ones too, each for medians of five
//   --markdown   prints the tables of doc/speed.md
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <string_view>
#include <vector>

#include "benchmarks.hpp"
#include "markdown_reporter.hpp"

int main(int argc, char** argv) {
  bool all = false;
  bool markdown = false;
  std::vector<char*> others;
  for (int i = 0; i < argc; ++i) {
    const std::string_view argument = argv[i];
    if (argument == "--all") {
      all = true;
    } else if (argument == "--markdown") {
      markdown = true;
    } else {
      others.push_back(argv[i]);
    }
  }
  int count = static_cast<int>(others.size());
  others.push_back(nullptr);
  benchmark::Initialize(&count, others.data());
  if (benchmark::ReportUnrecognizedArguments(count, others.data())) return 1;
  try {
    gearsweep::bench::add_benchmarks(all);
    if (markdown) {
      gearsweep::bench::MarkdownReporter reporter;
      benchmark::RunSpecifiedBenchmarks(&reporter);
    } else {
      benchmark::RunSpecifiedBenchmarks();
    }
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
  return 0;
}
