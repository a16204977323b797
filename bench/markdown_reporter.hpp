// Prints benchmarks as the tables of the README, one for each first part of their names, and on the
// error stream how far it is.
#pragma once

#include <benchmark/benchmark.h>

#include <string>
#include <vector>

namespace gearsweep::bench {

class MarkdownReporter : public benchmark::BenchmarkReporter {
 public:
  bool ReportContext(const Context& context) override;
  void ReportRuns(const std::vector<Run>& runs) override;
  void Finalize() override;

 private:
  std::vector<Run> runs_;
};

// The tables, in the order of the runs: a row for each run, but for "matrix/ROW/COLUMN", which
// become rows and columns. Of the counters only those that a table has a heading for; a run that
// could not be done gets its reason instead of numbers.
std::string markdown_tables(const std::vector<benchmark::BenchmarkReporter::Run>& runs);

}  // namespace gearsweep::bench
