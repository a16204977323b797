#include "orbits/require_multipliers.hpp"

#include <fmt/format.h>

#include <vector>

#include "model/error.hpp"

namespace gearsweep {
namespace {

void require_one_frequency(const Model& model) {
  if (model.clocks == 0) return;
  throw InputError(fmt::format(
      "model '{}' has two frequencies: its motions do not return, so they have no multipliers; "
      "lyapunov_spectrum says what grows beside them",
      model.name));
}

void require_smooth(const Study& study) {
  const std::vector<StateJump> jumps = study.model->state_jumps(study.setting);
  if (jumps.empty()) return;
  throw InputError(fmt::format(
      "model '{}': {} jumps with a state (in {}), and tangent vectors miss what that does to them: "
      "there are no multipliers; round the jump off, as tanh(v/0.01) does with sign(v)",
      study.model->name, jumps.front().expression, jumps.front().place));
}

}  // namespace

void require_multipliers(const Study& study) {
  require_one_frequency(*study.model);
  require_smooth(study);
}

}  // namespace gearsweep
