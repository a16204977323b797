#include "study/detail/drawing_axis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "model/error.hpp"
#include "study/detail/toml_access.hpp"

namespace gearsweep {
namespace {

std::vector<GearConversion> conversions_of(const GearKey& key, const toml::table& gear,
                                           const GearValues& others, const Model& model,
                                           const toml::node& place, const Axis& axis) {
  std::vector<GearConversion> conversions;
  GearDrawing drawing = read_drawing(gear, others);
  for (const double value : axis.values) {
    try {
      drawing.vary(key, value);
      conversions.push_back(convert_gear(drawing, model, gear));
    } catch (const InputError& error) {
      fail_at(place, fmt::format("{} = {}: {}", key.name, value, error.what()));
    }
    if (conversions.back().scales == conversions.front().scales) continue;
    fail_at(place,
            fmt::format("{} changes what the result is measured in: its lengths are in half "
                        "backlashes, its forces in k0 b_n, its times in 1/varpi; sweep it in a "
                        "study for each value",
                        key.name));
  }
  return conversions;
}

const GearParameter* find_parameter(const GearConversion& conversion, const std::string& name) {
  const auto found = std::ranges::find(conversion.parameters, name, &GearParameter::name);
  return found == conversion.parameters.end() ? nullptr : &*found;
}

}  // namespace

const GearKey* find_swept_key(const Model& model, const std::string& name) {
  // Another model may have a parameter of that name.
  if (!takes_drawing(model)) return nullptr;
  const auto* const found = std::ranges::find(kGearKeys, name, &GearKey::name);
  return found != std::end(kGearKeys) && found->can_vary() ? found : nullptr;
}

void bind_key(const GearKey& key, Axis* axis) {
  axis->unit = key.unit();
  axis->meaning = std::string(key.meaning);
}

void add_parameters(const GearKey& key, const toml::table& gear, const GearValues& others,
                    const Model& model, const toml::node& place, Axis* axis) {
  const std::vector<GearConversion> conversions =
      conversions_of(key, gear, others, model, place, *axis);
  for (const GearParameter& parameter : conversions.front().parameters) {
    Swept column;
    column.name = parameter.name;
    for (const GearConversion& conversion : conversions) {
      column.values.push_back(find_parameter(conversion, parameter.name)->value);
    }
    const bool differs = std::ranges::any_of(
        column.values, [&](double value) { return value != column.values.front(); });
    if (!differs && parameter.key != key.name) continue;
    column.index = static_cast<std::size_t>(model.find_parameter(parameter.name));
    column.unit = model.parameters[column.index].unit;
    column.meaning = model.parameters[column.index].meaning;
    axis->columns.push_back(std::move(column));
  }
  if (axis->columns.empty()) {
    fail_at(place, fmt::format("{} changes nothing in the equations of this study ({})", key.name,
                               key.meaning));
  }
}

GearValues first_values(const Model& model, const std::vector<Axis>& axes) {
  GearValues values;
  for (const Axis& axis : axes) {
    if (find_swept_key(model, axis.name) != nullptr) values[axis.name] = axis.values.front();
  }
  return values;
}

}  // namespace gearsweep
