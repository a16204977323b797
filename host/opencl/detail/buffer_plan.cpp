#include "opencl/detail/buffer_plan.hpp"

#include "sweep_types.h"

namespace gearsweep {

RecordBuffers record_buffers(const Study& study, std::size_t samples, std::size_t slots) {
  const Selection& selection = study.selection;
  const std::size_t states = study.model->states.size();
  return {.state = states * slots,
          .tangents = selection.tangent_count() * states * slots,
          .accumulators = selection.accumulator_count() * slots,
          .series = selection.poincare.size() * samples * slots,
          .outputs = selection.output_count() * slots};
}

ApproachBuffers approach_buffers(const Study& study, std::size_t slots) {
  const std::size_t states = study.model->states.size();
  return {.state = states * slots,
          .periods = slots,
          .sections = (ORBIT_LONGEST + 1) * states * slots,
          .ranges = states * slots,
          .lengths = slots,
          .guesses = states * slots};
}

ReturnMapBuffers return_map_buffers(const Study& study, std::size_t slots) {
  const std::size_t states = study.model->states.size();
  return {.state = states * slots, .lengths = slots, .derivative = states * states * slots};
}

ReplayBuffers replay_buffers(const Study& study, std::size_t length, std::size_t slots) {
  const Selection& selection = study.selection;
  const std::size_t states = study.model->states.size();
  return {.state = states * slots,
          .log_stretching = selection.tangent_count() * slots,
          .sections = length * states * slots,
          .accumulators = selection.accumulator_count() * slots,
          .outputs = selection.output_count() * slots};
}

}  // namespace gearsweep
