#include "gear/detail/parameters.hpp"

#include <fmt/format.h>

namespace gearsweep {

void GearParameters::add(std::string_view name, double value, const GearKey& origin,
                         std::string note) {
  const int index = model_.find_parameter(name);
  if (index < 0) return;
  const ParameterInfo& info = model_.parameters[static_cast<std::size_t>(index)];
  if (!(value >= info.min && value <= info.max)) {
    throw DrawingError(
        origin,
        fmt::format("{} gives {} = {:.6g}, out of range; from {:g} to {:g} is allowed ({}: {})",
                    drawing_.has(origin) ? origin.name : std::string_view(drawing_.name()), name,
                    value, info.min, info.max, info.meaning, note));
  }
  list_.push_back({std::string(name), value, std::move(note), origin.name});
}

}  // namespace gearsweep
