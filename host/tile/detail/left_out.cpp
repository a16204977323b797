#include "tile/detail/left_out.hpp"

#include <optional>
#include <vector>

#include "plan/passive_states.hpp"
#include "sweep_types.h"

namespace gearsweep {
void add_left_out_exponents(const Plan& plan, const Tile& tile, TileResult* result) {
  const Study& study = plan.study();
  const auto exponent = study.selection.output_of(OutputRole::exponent);
  if (study.model->whole == nullptr || !exponent) return;
  const auto error = study.selection.output_of(OutputRole::exponent_error);
  const auto per_period = study.selection.output_of(OutputRole::exponent_per_period);
  const Array2<double> outputs = result->output_table();
  for (std::size_t i = 0; i < tile.points.size(); ++i) {
    if (result->status[i] != STATUS_ok) continue;
    const ModelSetting setting = plan.setting_of(tile.points[i]);
    const double largest = left_out_exponents(*study.model, setting).front();
    if (!(outputs[*exponent][i] < largest)) continue;
    outputs[*exponent][i] = largest;
    outputs[*error][i] = 0.0;
    outputs[*per_period][i] = largest * study.model->period(setting);
  }
}

}  // namespace gearsweep
