#include "sweep/detail/map_value.hpp"

#include <limits>

namespace gearsweep {

double map_value(const Plan& plan, const Quantity& quantity, std::size_t part,
                 std::size_t trajectory, const TileResult& result, std::size_t position) {
  const double value = result.output_table()[quantity.output + part][position];
  if (quantity.is_per_time) return value / plan.study().model->binding.clock;
  if (!quantity.divided_by) return value;
  const double divisor = plan.setting_of(trajectory).parameters[*quantity.divided_by];
  return divisor == 0.0 ? std::numeric_limits<double>::quiet_NaN() : value / divisor;
}

}  // namespace gearsweep
