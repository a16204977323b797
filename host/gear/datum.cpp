#include "gear/datum.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <iterator>

#include "gear/drawing.hpp"

namespace gearsweep {
namespace {

std::string text_of(const std::vector<double>& numbers) {
  std::vector<std::string> texts;
  for (const double number : numbers) texts.push_back(fmt::format("{:.6g}", number));
  const bool are_same =
      std::ranges::all_of(texts, [&](const std::string& text) { return text == texts.front(); });
  if (are_same && !texts.empty()) texts.resize(1);
  return fmt::format("{}", fmt::join(texts, ", "));
}

GearDatum own_datum(const GearDrawing& drawing, const GearKey& key) {
  GearDatum datum;
  datum.key = key.name;
  if (key.is_measured()) {
    datum.value = "measured: " + drawing.measured(key)->source;
  } else if (key.form == KeyForm::word) {
    datum.value = drawing.choice(key);
  } else {
    datum.value = drawing.varies(key) ? "swept" : text_of(drawing.numbers(key));
  }
  if (drawing.is_estimated(key)) datum.origin = DatumOrigin::estimated;
  if (key.name == kDampingRatio.name) {
    datum.origin = DatumOrigin::estimated;
    datum.reason = "share of the critical damping";
  }
  return datum;
}

// What stands for a key that the drawing does not have; nothing where nothing does.
std::vector<GearDatum> other_datum(const GearDrawing& drawing, const WorkedOut& worked_out,
                                   const GearKey& key) {
  const auto datum = [&](const std::vector<double>& numbers, DatumOrigin origin,
                         std::string_view reason) {
    return std::vector{GearDatum{key.name, text_of(numbers), origin, std::string(reason), ""}};
  };
  const bool is_solid = drawing.choice(kBody) == "solid";
  const bool is_by_width = !drawing.has(kMeshStiffness) && !drawing.has(kStiffnessFile);
  if ((key.name == kMass.name || key.name == kInertia.name) && is_solid) {
    const std::vector<double>& own = key.name == kMass.name ? worked_out.mass : worked_out.inertia;
    return datum(own, DatumOrigin::estimated, "steel discs");
  }
  if (key.name == kMeshStiffness.name) {
    if (!is_by_width) return datum({worked_out.stiffness}, DatumOrigin::given, "mean of the file");
    return datum({worked_out.stiffness}, DatumOrigin::estimated, "ISO 6336-1, method B");
  }
  if (key.name == kCentreDistance.name) {
    return datum({worked_out.centre}, DatumOrigin::by_default, "without play");
  }
  if (key.name == kContactRatio.name) {
    return datum({worked_out.contact_ratio}, DatumOrigin::by_default, "from the geometry");
  }
  if (key.name == kAddendum.name && !drawing.has(kTipDiameter)) {
    return datum({drawing.required(kModule)}, DatumOrigin::by_default, key.fallback);
  }
  if (key.name == kDedendum.name && is_by_width) {
    return datum({1.25 * drawing.required(kModule)}, DatumOrigin::by_default, key.fallback);
  }
  if (key.name == kTorque.name && drawing.has(kTorqueFile)) {
    return datum({worked_out.torque}, DatumOrigin::given, "mean of the file");
  }
  const bool is_number = !key.fallback.empty() && key.form < KeyForm::word &&
                         std::isdigit(static_cast<unsigned char>(key.fallback.front())) != 0;
  const bool is_phase = key.name == kErrorPhase.name || key.name == kRunoutPhase.name;
  if (!is_number || is_phase || key.name == kDedendum.name) return {};
  if (key.name == kBore.name && !is_solid) return {};
  return {{key.name, std::string(key.fallback), DatumOrigin::by_default, "", ""}};
}

}  // namespace

std::vector<GearDatum> data_of(const GearDrawing& drawing, const WorkedOut& worked_out,
                               const std::function<bool(const GearKey&)>& is_taken) {
  std::vector<GearDatum> data;
  for (const GearKey& key : kGearKeys) {
    if (key.name == kBody.name || !is_taken(key)) continue;
    if (drawing.has(key)) {
      data.push_back(own_datum(drawing, key));
    } else {
      std::ranges::move(other_datum(drawing, worked_out, key), std::back_inserter(data));
    }
  }
  return data;
}

}  // namespace gearsweep
