// Whether a trajectory converges to a periodic orbit, judged by its own returns. Private to this
// folder.
//
// Let e be the distance of a return from the orbit and M the derivative of the return map there. M
// contracts in a norm of its own (that of P = M'PM/r^2 + 1, with r between the largest multiplier
// and 1), and the next distance differs from M e by what the map has beside its linear part, which
// shrinks faster than e does. So where that difference is small against the contraction, it stays
// so, and the trajectory goes on to the orbit. All distances are relative to the ranges of the
// motion: offset and units do not matter.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace gearsweep {

// A periodic orbit, seen once in each of its periods.
struct OrbitMap {
  std::vector<double> state;
  std::vector<double> derivative;   // [column][row] of the return map; all multipliers below 1
  std::vector<double> ranges;       // [state] of the motion
  std::vector<std::size_t> angles;  // states that mean the same after a full turn
  double same = 0.0;                // relative distance at which two states count as one
};

class OrbitConvergence {
 public:
  enum class Verdict { open, converges, leaves };

  explicit OrbitConvergence(OrbitMap orbit);

  // The state of the trajectory one period of the orbit after the last one that was added.
  Verdict add(const double* state);

 private:
  double norm(const Eigen::VectorXd& distance) const;
  bool is_explained(const Eigen::VectorXd& distance) const;

  OrbitMap orbit_;
  Eigen::MatrixXd map_;       // the derivative, relative to the ranges
  Eigen::MatrixXd metric_;    // P
  double contraction_ = 0.0;  // r
  double noise_ = 0.0;        // norm of a distance that counts as none
  Eigen::VectorXd last_;      // distance; empty before the first return
  double first_norm_ = 0.0;   // where the present run of returns began that M explains
  std::size_t explained_ = 0;
  double surprises_ = 0.0, patience_ = 0.0;  // returns that M does not explain, and how many may be
  double surprised_from_ = 0.0;              // norm from which on they are counted
};

}  // namespace gearsweep
