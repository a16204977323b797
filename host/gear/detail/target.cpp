#include "gear/detail/target.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

#include "model/names.hpp"

namespace gearsweep {
namespace {

// What a drawing calls `name` in the model. The frequency of the phase is that of the drawing that
// the model counts in, and has no suffix.
std::string name_in(const Model& model, const std::string& suffix, std::string_view name) {
  std::string full = std::string(name) + suffix;
  if (name == "omega" && suffix == "_" + model.unit_drawing) return "omega";
  return full;
}

}  // namespace

bool takes_key(const Model& model, const std::string& suffix, const GearKey& key) {
  if (key.gives.front().empty()) return true;
  return std::ranges::any_of(key.gives, [&](std::string_view name) {
    if (name.empty()) return false;
    const std::string full = name_in(model, suffix, name);
    return model.find_parameter(full) >= 0 ||
           std::ranges::find(model.curves, full) != model.curves.end();
  });
}

GearTarget::GearTarget(const GearDrawing& drawing, const Model& model, std::string suffix,
                       GearTexts texts)
    : drawing_(drawing), model_(model), suffix_(std::move(suffix)), texts_(texts) {
  for (const GearKey& key : kGearKeys) {
    if (!drawing.has(key) || takes(key)) continue;
    std::vector<std::string> names;
    for (const std::string_view name : key.gives) {
      if (!name.empty()) names.push_back(std::string(name) + suffix_);
    }
    throw DrawingError(key, fmt::format("{} gives {}, which model '{}' does not have", key.name,
                                        fmt::join(names, ", "), model.name));
  }
}

bool GearTarget::takes(const GearKey& key) const { return takes_key(model_, suffix_, key); }

bool GearTarget::has_curve(std::string_view name) const {
  return std::ranges::find(model_.curves, name) != model_.curves.end();
}

std::string GearTarget::full_name(const std::string& name) const {
  return name_in(model_, suffix_, name);
}

void GearTarget::add_noted(std::string name, double value, const GearKey& origin,
                           fmt::string_view note, fmt::format_args args) {
  const int index = model_.find_parameter(name);
  const auto giver = [&] { return drawing_.has(origin) ? origin.name : drawing_.name(); };
  if (index < 0) {
    if (origin.gives.front().empty() || value == 0.0) return;
    throw DrawingError(origin, fmt::format("{} gives {} = {:.6g}, which model '{}' does not have",
                                           giver(), name, value, model_.name));
  }
  const ParameterInfo& info = model_.parameters[static_cast<std::size_t>(index)];
  if (!(value >= info.min && value <= info.max)) {
    throw DrawingError(
        origin, fmt::format("{} gives {} = {:.6g}, out of range; from {:g} to {:g} is allowed ({}: "
                            "{})",
                            giver(), name, value, info.min, info.max, info.meaning,
                            fmt::vformat(note, args)));
  }
  out_.parameters.push_back(
      {std::move(name), value, has_texts() ? fmt::vformat(note, args) : "", origin.name});
}

void GearTarget::add_curve(const std::string& name, std::shared_ptr<const PeriodicTable> curve) {
  if (has_curve(name + suffix_)) out_.curves[name + suffix_] = std::move(curve);
}

void GearTarget::choose(const std::string& option, const std::string& choice) {
  const int index = model_.find_option(option + suffix_);
  if (index < 0) return;
  const auto& choices = model_.options[static_cast<std::size_t>(index)].choices;
  if (std::ranges::find(choices, choice) == choices.end()) return;
  out_.options.push_back({option + suffix_, choice});
}

}  // namespace gearsweep
