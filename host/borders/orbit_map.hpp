// The orbit map: where states come to after a number of forcing periods, with the derivative of
// that by the state, for many points of a model at once. Whoever wants a derivative by a parameter
// asks for its difference in the same batch.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

namespace gearsweep {

struct OrbitQuery {
  std::vector<double> values;  // of the map's parameters, in their order
  Eigen::VectorXd state;       // at phase 0
  std::size_t period = 1;      // so many forcing periods
};

struct OrbitAnswer {
  Eigen::VectorXd image;
  Eigen::MatrixXd derivative;  // [state][state]
};

// Threads may share one.
class OrbitMap {
 public:
  virtual ~OrbitMap() = default;
  // An answer to each query, in their order; nothing where the motion leaves the range that counts
  // as finite. Throws RunError where a device fails, SearchStopped where it is told to stop.
  virtual std::vector<std::optional<OrbitAnswer>> answer(
      const std::vector<OrbitQuery>& queries) = 0;
};

}  // namespace gearsweep
