// How many floating-point operations a model's equations take.
#pragma once

#include "equations/detail/lowering.hpp"
#include "equations/detail/tangent_program.hpp"
#include "model/model.hpp"

namespace gearsweep {

// Counts what kernels work out, each operation once.
StepWork step_work_of(const Formula& formula, const Lowered& lowered,
                      const TangentProgram& tangent);

}  // namespace gearsweep
