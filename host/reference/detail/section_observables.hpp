// The reference engine's observables of a section: where a motion comes up through it is found by
// halving, with steps of the method itself.
#pragma once

#include <functional>
#include <limits>
#include <memory>

#include "model/model.hpp"
#include "reference/detail/motion_range.hpp"
#include "reference/detail/observables.hpp"

namespace gearsweep {

// Tells where a motion comes up through a section.
class SectionWatch {
 public:
  // states: where it did so, with the time from the beginning, in periods.
  using Callback = std::function<void(const Eigen::VectorXd& state, double time)>;
  explicit SectionWatch(const SectionInfo& section) : section_(section) {}
  void see(const TrajectoryStep& step, const Callback& came);
  // Whether the section's level was a finite number so far.
  bool is_defined() const { return is_defined_; }

 private:
  // Rounding of its terms is 0.
  double level(const Instant& moment) const;

  SectionInfo section_;
  double last_ = std::numeric_limits<double>::infinity();  // where the step before ended
  double time_ = 0.0;
  bool is_defined_ = true;
};

// Returns per period; mean, shortest and longest time from one to the next (kernels/observables/
// returns.h).
std::unique_ptr<ReferenceObservable> make_returns(const SectionInfo& section);
// Returns after which the motion repeats, and the time that takes (kernels/observables/cycle.h).
std::unique_ptr<ReferenceObservable> make_cycle(const SectionInfo& section, double tolerance,
                                                const StateKinds& kinds);
// The kind of motion where there is no clock (kernels/observables/return_motion.h); needs two
// tangent vectors, or of one state one. has_room: for tori and chaos.
std::unique_ptr<ReferenceObservable> make_return_motion(const SectionInfo& section,
                                                        double tolerance, const StateKinds& kinds,
                                                        bool has_room);

}  // namespace gearsweep
