#include "study/detail/drawing_axis.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "model/error.hpp"
#include "study/detail/toml_access.hpp"

namespace gearsweep {
namespace {

// What to do where a key changes the scales.
std::string instead_of(const GearKey& key, const Model& model) {
  const char* const backlash = "b";
  if (key.name == kHalfBacklash.name && model.find_parameter(backlash) >= 0) {
    return "sweep b, the half backlash in terms of that of the drawing: 1.2 is 20 % more";
  }
  return "sweep it in a study for each value";
}

std::vector<GearConversion> conversions_of(const SweptKey& swept, const GearValues& others,
                                           const Model& model, const toml::node& place,
                                           const Axis& axis) {
  std::vector<GearConversion> conversions;
  GearDrawing drawing = read_drawing(swept.from, others);
  for (const double value : axis.values) {
    try {
      drawing.vary(*swept.key, value);
      conversions.push_back(convert_gear(drawing, model, swept.from));
    } catch (const InputError& error) {
      fail_at(place, fmt::format("{} = {}: {}", axis.name, value, error.what()));
    }
    if (conversions.back().scales == conversions.front().scales) continue;
    fail_at(place, fmt::format("{} changes what the result is measured in: its lengths are in half "
                               "backlashes, its forces in k0 b_n, its times in 1/varpi; {}",
                               axis.name, instead_of(*swept.key, model)));
  }
  return conversions;
}

const GearParameter* find_parameter(const GearConversion& conversion, const std::string& name) {
  const auto found = std::ranges::find(conversion.parameters, name, &GearParameter::name);
  return found == conversion.parameters.end() ? nullptr : &*found;
}

}  // namespace

std::vector<SweptKey> swept_keys(const toml::table& study, const Model& model) {
  std::vector<SweptKey> keys;
  for (const DrawingTable& from : drawing_tables(study, model)) {
    for (const GearKey& key : kGearKeys) {
      const SweptKey swept{&key, from};
      const bool is_of_model =
          model.find_parameter(swept.name()) >= 0 || model.find_state(swept.name()) >= 0;
      if (key.can_vary() && !is_of_model) keys.push_back(swept);
    }
  }
  return keys;
}

std::optional<SweptKey> find_swept_key(const toml::table& study, const Model& model,
                                       const std::string& name) {
  for (const SweptKey& swept : swept_keys(study, model)) {
    if (swept.name() == name) return swept;
  }
  return std::nullopt;
}

void bind_key(const GearKey& key, Axis* axis) {
  axis->unit = key.unit();
  axis->meaning = std::string(key.meaning);
}

void add_parameters(const SweptKey& swept, const GearValues& others, const Model& model,
                    const toml::node& place, Axis* axis) {
  const std::vector<GearConversion> conversions =
      conversions_of(swept, others, model, place, *axis);
  for (const GearParameter& parameter : conversions.front().parameters) {
    Swept column;
    column.name = parameter.name;
    for (const GearConversion& conversion : conversions) {
      column.values.push_back(find_parameter(conversion, parameter.name)->value);
    }
    const bool differs = std::ranges::any_of(
        column.values, [&](double value) { return value != column.values.front(); });
    if (!differs && parameter.key != swept.key->name) continue;
    column.index = static_cast<std::size_t>(model.find_parameter(parameter.name));
    column.unit = model.parameters[column.index].unit;
    column.meaning = model.parameters[column.index].meaning;
    axis->columns.push_back(std::move(column));
  }
  if (axis->columns.empty()) {
    fail_at(place, fmt::format("{} changes nothing in the equations of this study ({})", axis->name,
                               swept.key->meaning));
  }
}

GearValues first_values(const toml::table& study, const Model& model, const DrawingTable& from,
                        const std::vector<Axis>& axes) {
  GearValues values;
  for (const Axis& axis : axes) {
    const std::optional<SweptKey> swept = find_swept_key(study, model, axis.name);
    if (!swept || swept->from.suffix != from.suffix) continue;
    values[std::string(swept->key->name)] = axis.values.front();
  }
  return values;
}

}  // namespace gearsweep
