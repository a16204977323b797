// The map that carries a state from phase 0 to phase 0 one forcing period later, with its
// derivative: the classical Runge-Kutta method on the phase grid, and the same steps differentiated
// (so the monodromy matrix is that of the discrete map to rounding, and Newton's method converges
// on it). Shares nothing with the kernels but the model's formula and the phase grid.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>

#include "plan/phase_grid.hpp"

namespace gearsweep {

// Where a state comes to and the derivative of that by the state, [state][state].
struct PeriodImage {
  Eigen::VectorXd state;
  Eigen::MatrixXd monodromy;
};

class PeriodMap {
 public:
  // At least `steps` steps per period. The model must outlive the map.
  PeriodMap(const Model& model, const ModelSetting& setting, std::size_t steps);

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
  template <class Step>
  void each_step(const Step& step) const;

  PhaseGrid grid_;
  std::size_t row_width_;
  std::unique_ptr<PreparedPoint> point_;
};

}  // namespace gearsweep
