// The orbit map: where states come to after a number of forcing periods, with the derivative of
// that by the state, for many points of a model at once. Whoever wants a derivative by a parameter
// asks for its difference in the same batch.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

namespace gearsweep {

// A limit that a motion may touch, and from which side: one of the model's surfaces, or behind them
// of Model::contact_limits().
struct GrazedLimit {
  std::size_t index = 0;
  bool is_from_below = true;  // the level of the limit has a maximum there, not a minimum

  bool operator==(const GrazedLimit&) const = default;
};

// A turn of a limit's level along a motion, by where it is looked for.
struct GrazeMark {
  GrazedLimit limit;
  double moment = 0.0;  // in forcing periods after phase 0
};

// The turn itself.
struct LevelTurn {
  double level = 0.0;           // 0: the motion only just touches
  Eigen::RowVectorXd gradient;  // of the level by the state that the motion begins with
  double moment = 0.0;
};

struct OrbitQuery {
  std::vector<double> values;  // of the map's parameters, in their order
  Eigen::VectorXd state;       // at phase 0
  std::size_t period = 1;      // so many forcing periods
  // Both of the host's maps alone. is_half: the image is that of the mirrored model, after half of
  // `period`: see mirror_symmetry.hpp.
  bool is_half = false;
  std::optional<GrazeMark> graze = {};
  bool needs_derivative = true;  // without it the host is more than twice as fast
};

struct OrbitAnswer {
  Eigen::VectorXd image;
  Eigen::MatrixXd derivative;  // [state][state]; of no columns where none was asked for
  std::optional<LevelTurn> turn = {};
};

// Threads may share one.
class OrbitMap {
 public:
  virtual ~OrbitMap() = default;
  // An answer to each query, in their order; nothing where the motion leaves the range that counts
  // as finite, or has no turn near where it is looked for. Throws RunError where a device fails,
  // SearchStopped where it is told to stop.
  virtual std::vector<std::optional<OrbitAnswer>> answer(
      const std::vector<OrbitQuery>& queries) = 0;
};

}  // namespace gearsweep
