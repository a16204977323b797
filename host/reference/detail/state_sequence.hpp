// A sequence of states of a motion, at phase 0 of each period or at its returns to a section, all
// of which are kept, so that the definition of a period (kernels/recurrence.h) is followed as it
// stands.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "reference/detail/motion_range.hpp"

namespace gearsweep {

// The period with which the sections recur, 0: none; the section from which on they do; and the
// largest distance between those that recur.
struct Recurrence {
  std::size_t period = 0, since = 0;
  double worst = 0.0;
};

class StateSequence {
 public:
  // Two are the same when no component differs by more than `tolerance` times the range of the
  // motion; with is_local of the motion from the one to the other.
  StateSequence(double tolerance, const StateKinds& kinds, bool is_local = false)
      : tolerance_(tolerance), range_(kinds, tolerance), is_local_(is_local) {}
  void begin(const Eigen::VectorXd& state);
  // A moment between two sections.
  void pass(const Eigen::VectorXd& state) { range_.widen(state); }
  void add(const Eigen::VectorXd& state);
  bool is_empty() const { return states_.empty(); }
  // How many were added, which is also the number of the last one.
  std::size_t last() const { return states_.size() - 1; }

  // At each reference from some section on, the multiples of the period recur and nothing between
  // them does; no two periods can do so. It counts when two multiples do or more, and for a quarter
  // of the sequence, and when what is between them misses by far more than they do. The longest
  // window: a power of two.
  Recurrence recurrence(std::size_t longest_window) const;

  // The box of the sections from `first` to `final`: its longest side, relative to the ranges; 0
  // where a motion that diverged has no such sections.
  double extent(std::size_t first, std::size_t final) const;

  // The smallest distance between sections that are compared, up to half a window apart.
  double closest(std::size_t longest_window) const;

 private:
  // A section that others are compared with, up to the last of its window.
  struct Reference {
    std::size_t section, window_end;
  };
  // How often sections recurred, and since which reference; the largest distance among those that
  // did, the smallest among the others.
  struct Stretch {
    std::size_t recurrences = 0, since = 0;
    double worst = 0.0, nearest = std::numeric_limits<double>::infinity();
  };

  std::vector<Reference> references(std::size_t longest_window) const;
  // j: before i.
  double distance(std::size_t i, std::size_t j) const;
  // The stretch with a window before it; nothing when one of the multiples of the period is not the
  // same as the reference, or when another section up to lag `most` is.
  std::optional<Stretch> with(const Reference& reference, std::size_t period, std::size_t most,
                              Stretch stretch) const;
  // The last references from which on the period recurs throughout.
  Stretch final_stretch(std::size_t period, std::size_t longest_window) const;

  double tolerance_;
  MotionRange range_;
  bool is_local_;
  std::vector<Eigen::VectorXd> states_;
  std::vector<Eigen::VectorXd> ranges_;  // [section] of the motion since the one before; is_local_
};

}  // namespace gearsweep
