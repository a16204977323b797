#include "gear/detail/target.hpp"

#include <fmt/format.h>

#include "model/names.hpp"

namespace gearsweep {

void GearTarget::add(const std::string& name, double value, const GearKey& origin, std::string note,
                     std::size_t i) {
  const std::string full = name_in_list(name, i);
  const int index = model_.find_parameter(full);
  if (index < 0) return;
  const ParameterInfo& info = model_.parameters[static_cast<std::size_t>(index)];
  if (!(value >= info.min && value <= info.max)) {
    throw DrawingError(
        origin,
        fmt::format("{} gives {} = {:.6g}, out of range; from {:g} to {:g} is allowed ({}: {})",
                    drawing_.has(origin) ? origin.name : std::string_view(drawing_.name()), full,
                    value, info.min, info.max, info.meaning, note));
  }
  out_.parameters.push_back({full, value, std::move(note), origin.name});
}

}  // namespace gearsweep
