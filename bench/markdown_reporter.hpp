// Prints benchmarks as the tables of doc/speed.md, one for each first part of their names, as soon
// as it is whole: a row for each run, but for "matrix/ROW/COLUMN", which become rows and columns.
// It shows only counters that a table has a heading for; a run that could not be done gets its
// reason instead of numbers. The error stream tells how far it is.
#pragma once

#include <benchmark/benchmark.h>

#include <vector>

namespace gearsweep::bench {

class MarkdownReporter : public benchmark::BenchmarkReporter {
 public:
  bool ReportContext(const Context& context) override;
  void ReportRuns(const std::vector<Run>& runs) override;
  void Finalize() override;

 private:
  std::vector<Run> table_;  // runs of the one that is not whole yet
};

}  // namespace gearsweep::bench
