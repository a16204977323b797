// The map that carries a state from phase 0 to phase 0 one forcing period later, with its
// derivative: see flow.hpp. Shares nothing with the kernels but the model's formula and the phase
// grid.
#pragma once

#include <Eigen/Core>
#include <atomic>
#include <memory>
#include <optional>
#include <vector>

#include "orbits/flow.hpp"

namespace gearsweep {

// Where a state comes to and the derivative of that by the state, [state][state].
struct PeriodImage {
  Eigen::VectorXd state;
  Eigen::MatrixXd monodromy;
  // What the way there meets, as Flow tells it.
  std::vector<Graze> grazes;
  Extent extent;
};

// Thrown by a map that is told to stop.
class SearchStopped {};

class PeriodMap {
 public:
  // At least `steps` steps per period. The model must outlive the map. stop: set it to end what is
  // computed with the map after the running period; null: nobody will.
  PeriodMap(const Model& model, const ModelSetting& setting, std::size_t steps,
            const std::atomic<bool>* stop = nullptr);

  // The state `periods` forcing periods later. Nothing when it left the range that counts as
  // finite.
  std::optional<Eigen::VectorXd> advance(const Eigen::VectorXd& state, std::size_t periods) const;
  // The same with the monodromy matrix over these periods.
  std::optional<PeriodImage> linearize(const Eigen::VectorXd& state, std::size_t periods) const;

  // Whether the right-hand side depends on the phase; where it does not, a period means nothing.
  bool driven() const;
  // Forcing period in dimensionless time.
  double period() const { return point_->period(); }
  std::size_t steps() const { return grid_.steps; }

 private:
  // Advances; false when the state left the range.
  bool advance(Flow* flow, std::size_t periods) const;

  const Model* model_;
  ModelSetting setting_;
  PhaseGrid grid_;
  std::unique_ptr<PreparedPoint> point_;
  const std::atomic<bool>* stop_;
};

}  // namespace gearsweep
