// The map that carries a state from phase 0 to phase 0 one forcing period later, with its
// derivative: see flow.hpp. Where nothing depends on the phase it carries a state for any time.
// Shares nothing with the kernels but the model's formula and the phase grid.
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
  std::size_t returns = 0;  // of a motion that nothing drives, if the way is closed
};

// A time, dimensionless, and the equal steps that it is taken in.
struct TimeSpan {
  double duration = 0.0;
  std::size_t steps = 1;
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

  // Whether the right-hand side depends on the phase; where it does not, a period means nothing,
  // and the functions of a time are defined.
  bool driven() const;
  // As above, after a time.
  std::optional<Eigen::VectorXd> advance(const Eigen::VectorXd& state, const TimeSpan& span) const;
  // The same, with what it passes.
  struct Way {
    Eigen::VectorXd end;
    std::size_t returns = 0;
  };
  std::optional<Way> way(const Eigen::VectorXd& state, const TimeSpan& span) const;
  std::optional<PeriodImage> linearize(const Eigen::VectorXd& state, const TimeSpan& span) const;
  // The derivative of a motion by the time, and the derivative of that by the state.
  Eigen::VectorXd rate(const Eigen::VectorXd& state) const;
  Eigen::MatrixXd rate_slope(const Eigen::VectorXd& state) const;
  // How far it is from each surface, in the unit of its level: Model::surfaces.
  Eigen::VectorXd levels(const Eigen::VectorXd& state) const;

  // to - from, states that are angles by the shorter way around.
  Eigen::VectorXd difference(const Eigen::VectorXd& to, const Eigen::VectorXd& from) const;
  const Model& model() const { return *model_; }
  // Forcing period in dimensionless time.
  double period() const { return point_->period(); }
  std::size_t steps() const { return grid_.steps; }

 private:
  // Through the grid; false when the state left the range.
  bool advance(Flow* flow, std::size_t times, bool counts_returns = false) const;
  PhaseGrid grid_of(const TimeSpan& span) const;

  const Model* model_;
  ModelSetting setting_;
  PhaseGrid grid_;
  std::unique_ptr<PreparedPoint> point_;
  const std::atomic<bool>* stop_;
};

}  // namespace gearsweep
