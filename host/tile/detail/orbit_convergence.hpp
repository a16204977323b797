// Whether a trajectory converges to a periodic orbit, judged by its own returns.
//
// Let e be the distance of a return from the orbit and M the derivative of the return map there. A
// span is the number of returns, p, after which M^p halves every distance in the long run. M^p
// contracts in a norm of its own (that of the sum of (M^p/r)'^k (M^p/r)^k over all k, with r
// between the largest multiplier of M^p and 1), and the distance one span later differs from M^p e
// by what the map has beside its linear part, which shrinks faster than e does. So where that
// difference is small against the contraction, it stays so, and the trajectory goes on to the
// orbit. A single return would say the same, but asks for more where multipliers are near 1: there
// each return contracts so little that it drowns in what is not linear, even where that takes turns
// and comes to nothing (a trajectory that alternates, or goes round). All distances are relative to
// the ranges of the motion: offset and units do not matter.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

namespace gearsweep {

// A periodic orbit, seen once in each of its periods.
struct TargetOrbit {
  std::vector<double> state;
  std::vector<double> derivative;   // [column][row] of the return map
  double multiplier = 0.0;          // the largest, as an absolute value; below 1
  std::vector<double> ranges;       // [state] of the motion
  std::vector<std::size_t> angles;  // states that mean the same after a full turn
  double same = 0.0;                // relative distance at which two states count as one
};

class OrbitConvergence {
 public:
  enum class Verdict { open, converges, leaves };

  // A span is not longer than this: where multipliers are near 1 it leaves more than half, and what
  // is not linear must be the smaller.
  explicit OrbitConvergence(TargetOrbit orbit, int longest_span = 1000);

  // The state of the trajectory one period of the orbit after the last one that was added.
  Verdict add(std::span<const double> state);

 private:
  double norm(const Eigen::VectorXd& distance) const;
  // By the return a span before it. `now`: its norm.
  bool is_explained(const Eigen::VectorXd& distance, double now) const;

  TargetOrbit orbit_;
  Eigen::Index span_ = 1;        // p
  Eigen::MatrixXd map_;          // M^p, relative to the ranges
  Eigen::MatrixXd metric_;       // of the norm
  double contraction_ = 0.0;     // r
  double noise_ = 0.0;           // norm of a distance that counts as none
  Eigen::MatrixXd last_;         // [column] distance of a return of the last span
  Eigen::Index returns_ = 0;     // so far; the column of each is its number modulo the span
  Eigen::Index explained_ = 0;   // returns in a row that M^p explains
  Eigen::Index surprises_ = 0;   // returns that it does not explain,
  double surprised_from_ = 0.0;  // since the norm was this
};

}  // namespace gearsweep
