// The range of a motion, which distances between its states are relative to: offsets and units do
// not matter then.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "model/model.hpp"

namespace gearsweep {

// What a model says of its states.
struct StateKinds {
  std::vector<std::size_t> groups;  // [state]: the same number for those that share a range
  std::vector<std::size_t> angles;  // states, in radians, that mean the same after a full turn
  bool has_clock = false;           // the last state turns steadily
};

class MotionRange {
 public:
  // A range is at least so large that `tolerance` times it is 64 roundings of the state.
  MotionRange(StateKinds kinds, double tolerance);

  // Where a period begins, each step's end in it, and where it ends and the next one begins.
  void begin(const Eigen::VectorXd& state) { low_ = high_ = state; }
  void widen(const Eigen::VectorXd& state);
  // Returns the ranges of the period.
  Eigen::VectorXd end_period(const Eigen::VectorXd& state);

  // The largest component of the difference of two states, relative to the largest range during
  // any period of the states of its group; angles differ by half a turn at most.
  double distance(const Eigen::VectorXd& a, const Eigen::VectorXd& b) const {
    return distance(a, b, ranges_);
  }
  // The same relative to these ranges.
  double distance(const Eigen::VectorXd& a, const Eigen::VectorXd& b,
                  const Eigen::VectorXd& ranges) const;
  // The largest component of what is between two states, in the same terms.
  double size(const Eigen::VectorXd& apart) const { return size(apart, ranges_); }
  // The largest range of one state during any period.
  double of_state(Eigen::Index state) const { return ranges_[state]; }

 private:
  double size(const Eigen::VectorXd& apart, const Eigen::VectorXd& ranges) const;

  StateKinds kinds_;
  double min_;
  Eigen::VectorXd low_, high_;
  Eigen::VectorXd ranges_;  // empty before the first period
};

}  // namespace gearsweep
