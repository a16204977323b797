#include "measure/flop_count.hpp"

namespace gearsweep {

// rk4/rk4.h: four evaluations at three phases and eight advances of the state, each a product and a
// sum; of a tangent vector four products with the derivative, and six operations to join them.
double flops_per_step(const Study& study, std::size_t tangents) {
  const StepWork& work = study.model->work;
  const auto states = static_cast<double>(study.model->states.size());
  const double alone = 4.0 * work.of_state + 3.0 * work.of_phase + 16.0 * states;
  if (tangents == 0) return alone;
  const double each = 4.0 * work.of_tangent + 6.0 * states;
  return alone + 4.0 * work.of_linearization + static_cast<double>(tangents) * each;
}

}  // namespace gearsweep
