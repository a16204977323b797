// Where a run's maps go: result file, journal and picture.
#pragma once

#include <string>

#include "cli/run_request.hpp"
#include "engine/result.hpp"
#include "result/result_file.hpp"
#include "sweep/sweep_options.hpp"

namespace gearsweep {

class RunOutput {
 public:
  // Sees that the files can be written and the picture plotted, and tells of a result that will be
  // replaced. Throws InputError where not, or where a file would be lost that nobody named. Both
  // outlive it.
  RunOutput(const RunRequest& request, const Study& study);

  const std::string& path() const { return path_; }
  const std::string& journal() const { return journal_; }
  // The options of the run whose maps it takes.
  SweepOptions sweep_options() const;
  void discard_journal() const;
  // The file is there as a whole, or not at all.
  void write(const SweepResult& result) const;
  // Whether a picture was asked for.
  bool has_picture() const { return !request_.plot.empty(); }
  // Reads the file that was written, and plots it.
  void plot() const;

 private:
  Provenance provenance() const;

  const RunRequest& request_;
  std::string path_, journal_, command_;
  DeliveryEstimate delivery_;
};

}  // namespace gearsweep
