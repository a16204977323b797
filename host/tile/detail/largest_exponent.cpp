#include "tile/detail/largest_exponent.hpp"

#include <optional>
#include <vector>

#include "plan/passive_states.hpp"
#include "sweep_types.h"

namespace gearsweep {
namespace {

// The output that is the first of all exponents; nothing where the study does not ask for them.
std::optional<std::size_t> first_of_spectrum(const Selection& selection) {
  std::size_t first = 0;
  for (const Observer& observer : selection.observers) {
    if (observer.observable->name == "lyapunov_spectrum") return first;
    first += observer.outputs;
  }
  return std::nullopt;
}

}  // namespace

void complete_largest_exponents(const Plan& plan, const Tile& tile, TileResult* result) {
  const Study& study = plan.study();
  const Selection& selection = study.selection;
  const auto exponent = selection.output_of(OutputRole::exponent);
  const auto spectrum = first_of_spectrum(selection);
  const bool leaves_out = study.model->whole != nullptr;
  if (!exponent || (!spectrum && !leaves_out)) return;
  const std::size_t error = *selection.output_of(OutputRole::exponent_error);
  const std::size_t per_period = *selection.output_of(OutputRole::exponent_per_period);
  const Array2<double> outputs = result->output_table();
  for (std::size_t i = 0; i < tile.points.size(); ++i) {
    if (result->status[i] != STATUS_ok) continue;
    const ModelSetting setting = plan.setting_of(tile.points[i]);
    const auto replace = [&](double largest, double its_error) {
      outputs[*exponent][i] = largest;
      outputs[error][i] = its_error;
      outputs[per_period][i] = largest * study.model->period(setting);
    };
    const double own = outputs[*exponent][i];
    if (spectrum && own < outputs[*spectrum][i]) {
      replace(outputs[*spectrum][i], outputs[error][i] + outputs[*spectrum][i] - own);
    }
    if (!leaves_out) continue;
    const double left_out = left_out_exponents(*study.model, setting).front();
    if (outputs[*exponent][i] < left_out) replace(left_out, 0.0);
  }
}

}  // namespace gearsweep
