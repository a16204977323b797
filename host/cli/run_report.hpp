// What a run tells while it goes on, and at its end.
#pragma once

#include <optional>
#include <string>

#include "cli/detail/progress_bar.hpp"
#include "cli/run_output.hpp"
#include "cli/run_request.hpp"
#include "sweep/forecast.hpp"

namespace gearsweep {

// Tells of a trouble that the run survives, below its progress.
void warn(const std::string& what);

// Each function that ends a run gives its exit status.
class RunReport {
 public:
  // Both outlive it.
  RunReport(const RunRequest& request, const RunOutput& output);

  // Makes the run with these options tell this report, and stop on a signal. The report outlives
  // the run.
  void watch(SweepOptions* options);

  int forecast(const std::optional<Forecast>& forecast);  // nothing: interrupted
  int interrupted();
  int shard_done();
  // The result file and the picture are there: what each of them is told of.
  void written(const SweepResult& result);
  void plotted();
  int finished(const SweepResult& result);

 private:
  const RunRequest& request_;
  const RunOutput& output_;
  ProgressBar bar_;
  SweepProgress last_;
};

}  // namespace gearsweep
