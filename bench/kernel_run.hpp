// One kernel on the points of a study, ready to be timed.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/engine.hpp"

namespace gearsweep::bench {

// The default: gear5 on 64 x 64 points of a usual map, so that phase grids and their tables are
// those of real work, over 24 settling periods.
class KernelRun {
 public:
  // `settling`: times the kernel that settles, otherwise the one that records. Both have rounds of
  // equal length, and more than one. Runs it once, so that it is built.
  KernelRun(const std::vector<std::string>& overrides, bool settling);

  const Study& study() const { return study_; }
  const Plan& plan() const { return plan_; }
  const Tile& tile() const { return plan_.stages().front().tiles.front(); }
  bool settling() const { return settling_; }

  struct Rounds {
    double steps = 0.0, seconds = 0.0;
    double rate() const { return steps / seconds; }
  };
  // Times the launches alone: from the end of the first round of the kernel in question to the end
  // of its last one.
  Rounds run();

 private:
  const Study study_;
  const Plan plan_;
  const bool settling_;
  const std::unique_ptr<Engine> engine_;
  std::vector<double> initial_;
};

}  // namespace gearsweep::bench
