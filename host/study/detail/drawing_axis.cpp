#include "study/detail/drawing_axis.hpp"

#include <algorithm>

#include "model/error.hpp"
#include "study/detail/gear_table.hpp"

namespace gearsweep {
namespace {

// "torque_N_m" is in N m, "mesh_damping_N_s_per_mm" in N s/mm.
std::string unit_in(std::string_view key) {
  static const std::map<std::string_view, std::string> kUnits = {
      {"mm", "mm"},       {"deg", "degrees"},      {"kg_mm2", "kg mm^2"}, {"kg", "kg"},
      {"N_m", "N m"},     {"N_per_mm", "N/mm"},    {"um", "um"},          {"rpm", "rpm"},
      {"N_per_m", "N/m"}, {"N_s_per_mm", "N s/mm"}};
  std::string unit = "1";
  std::size_t longest = 0;
  for (const auto& [ending, written] : kUnits) {
    const std::string with_line = "_" + std::string(ending);
    if (!key.ends_with(with_line) || ending.size() <= longest) continue;
    unit = written;
    longest = ending.size();
  }
  return unit;
}

bool are_same(const Scales& a, const Scales& b) {
  return a.varpi == b.varpi && a.b_n == b.b_n && a.k0 == b.k0;
}

std::vector<GearConversion> conversions_of(const GearKey& key, const toml::table& gear,
                                           GearValues values, const toml::node& place,
                                           const Axis& axis) {
  std::vector<GearConversion> conversions;
  for (const double value : axis.values) {
    values[axis.name] = value;
    try {
      conversions.push_back(convert_gear(gear, values));
    } catch (const InputError& error) {
      fail_at(place, fmt::format("{} = {}: {}", key.name, value, error.what()));
    }
    if (are_same(conversions.back().scales, conversions.front().scales)) continue;
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
  if (!is_gear_table_model(model)) return nullptr;
  // Numbers of teeth are whole, and come in pairs.
  const auto* const found = std::ranges::find(kGearKeys, name, &GearKey::name);
  if (found == kGearKeys.end() || found->name == kTeeth.name) return nullptr;
  return found->is_number() ? &*found : nullptr;
}

void bind_key(const GearKey& key, Axis* axis) {
  axis->unit = unit_in(key.name);
  axis->meaning = std::string(key.meaning);
}

void add_parameters(const GearKey& key, const toml::table& gear, const GearValues& others,
                    const toml::node& place, Axis* axis) {
  const std::vector<GearConversion> conversions = conversions_of(key, gear, others, place, *axis);
  const Model& model = gear_table_model();
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
