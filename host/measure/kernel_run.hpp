// One kernel on the points of a study, ready to be timed.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "engine/engine.hpp"
#include "opencl/device.hpp"

namespace gearsweep {

// The default: gear5 on a usual map, so that phase grids and their tables are those of real work,
// over 24 settling periods. It has 64 x 64 points, and more where a device needs them to be busy.
class KernelRun {
 public:
  // `settling`: times the kernel that settles, otherwise the one that records. Both have rounds of
  // equal length, and more than one. `device` is a number of list_devices(). Runs it once, so that
  // it is built. Throws InputError for a device without the study's precision, RunError when it
  // fails.
  KernelRun(const std::vector<std::string>& overrides, bool settling, std::size_t device);

  const Study& study() const { return study_; }
  const Plan& plan() const { return plan_; }
  const Tile& tile() const { return plan_.stages().front().tiles.front(); }
  bool settling() const { return settling_; }
  std::string build_options() const { return engine_->info().macros; }

  struct Rounds {
    double steps = 0.0, seconds = 0.0;
    double core_seconds = 0.0;  // of processor time, of all threads
    double rate() const { return steps / seconds; }
  };
  // Times the launches alone: from the end of the first round of the kernel in question to the end
  // of its last one.
  Rounds run();
  // The same again and again, until so many seconds are timed; at least one round. What is timed is
  // worth nothing once `stop` is set, after which it returns soon.
  Rounds run_for(double seconds, const std::atomic<bool>& stop);

 private:
  // Whether another round is wanted, with these behind it.
  using GoesOn = std::function<bool(const Rounds&)>;
  Rounds pass(const GoesOn& goes_on);

  const Study study_;
  const Plan plan_;
  const bool settling_;
  const std::unique_ptr<Engine> engine_;
  std::vector<double> initial_;
};

}  // namespace gearsweep
