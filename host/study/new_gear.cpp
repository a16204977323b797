#include "study/new_gear.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <numbers>
#include <string_view>
#include <vector>

#include "gear/drawing_keys.hpp"
#include "study/draft.hpp"

namespace gearsweep {
namespace {

constexpr double kFastest = 50.0;  // pitch-line velocity, m/s

struct Given {
  std::string value;
  std::string estimate;  // why it is what it is; empty: somebody gave it
};

using GivenKeys = std::map<std::string_view, Given>;

// Two digits.
double rounded(double value) {
  const double unit = std::pow(10.0, std::floor(std::log10(value)) - 1.0);
  return std::round(value / unit) * unit;
}

GivenKeys keys_of(const NewGear& gear) {
  constexpr double kLoad = 100.0;      // N for each mm of width
  constexpr double kWidth = 10.0;      // modules
  constexpr double kBearing = 2e5;     // N/mm
  constexpr double kDamping = 1e-5;    // s
  constexpr double kBacklash = 0.025;  // modules
  GivenKeys keys;
  keys[kTeeth.name] = {fmt::format("[{}, {}]", gear.teeth[0], gear.teeth[1]), ""};
  keys[kModule.name] = {fmt::format("{}", gear.module_mm), ""};
  const double width = gear.face_width_mm.value_or(kWidth * gear.module_mm);
  keys[kFaceWidth.name] = {fmt::format("{}", width), gear.face_width_mm ? "" : "ten modules"};
  if (gear.helix_angle_deg) keys[kHelix.name] = {fmt::format("{}", *gear.helix_angle_deg), ""};
  keys[kBody.name] = {"\"solid\"", "steel discs without a bore, for mass_kg and inertia_kg_mm2"};
  keys[kBearingStiffness.name] = {fmt::format("{}", kBearing), "that of two ball bearings"};
  keys[kBearingDamping.name] = {fmt::format("{}", kDamping * kBearing),
                                "1e-5 s times their stiffness"};
  keys[kDampingRatio.name] = {"0.07", "between 0.03 and 0.17"};
  keys[kHalfBacklash.name] = {fmt::format("{}", kBacklash * gear.module_mm), "0.025 modules"};
  const double radius = 0.5 * gear.module_mm * gear.teeth[0];
  keys[kTorque.name] = {
      fmt::format("{}", gear.torque_N_m.value_or(rounded(kLoad * width * radius * 1e-3))),
      gear.torque_N_m ? "" : "100 N for each mm of the face width"};
  keys[kTransmissionError.name] = {"5", "of ground teeth"};
  return keys;
}

// Lines of a comment, of up to 100 letters.
std::string comment(const std::string& text) {
  constexpr std::size_t kWidth = 98;
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    std::size_t end = text.size();
    if (end - at > kWidth) end = text.rfind(' ', at + kWidth);
    out += fmt::format("# {}\n", text.substr(at, end - at));
    at = end + 1;
  }
  return out;
}

// Behind a #, with what it would be without it where that is a value.
std::string line_of_other(const GearKey& key) {
  const bool is_value = !key.fallback.empty() &&
                        (std::isdigit(static_cast<unsigned char>(key.fallback.front())) != 0 ||
                         key.fallback.front() == '"');
  const bool is_told = !key.fallback.empty() && !is_value && !key.fallback.starts_with("needed");
  return comment(fmt::format("{}{}{}", key.meaning, is_told ? "; without it: " : "",
                             is_told ? key.fallback : "")) +
         fmt::format("# {} = {}\n", key.name,
                     is_value            ? std::string(key.fallback)
                     : key.is_measured() ? "\"FILE.csv\""
                                         : "...");
}

std::string line_of(const GearKey& key, const GivenKeys& given) {
  const auto found = given.find(key.name);
  if (found == given.end()) return line_of_other(key);
  std::string text(key.meaning);
  if (!found->second.estimate.empty()) {
    text += fmt::format("; ESTIMATE: {}", found->second.estimate);
    if (!key.advice.empty()) text += fmt::format(". Better: {}", key.advice);
  }
  return comment(text) + fmt::format("{} = {}\n", key.name, found->second.value);
}

std::string drawing_of(const NewGear& gear) {
  const GivenKeys given = keys_of(gear);
  std::string text = "[gear]\n";
  std::vector<std::string> guesses;
  for (const GearKey& key : kGearKeys) {
    text += line_of(key, given);
    const auto found = given.find(key.name);
    const bool is_guess = found != given.end() && !found->second.estimate.empty();
    if (is_guess && key.name != kBody.name) guesses.push_back(fmt::format("  \"{}\"", key.name));
  }
  return text + comment("what is estimated, for reports: take out what you put your number at") +
         fmt::format("estimated = [\n{},\n]\n", fmt::join(guesses, ",\n"));
}

}  // namespace

std::string new_gear_study(const NewGear& gear) {
  const std::string model = "[model]\nname = \"gear5\"\nbacklash = \"dynamic\"\n";
  const std::string drawing = drawing_of(gear);
  const Study draft = read_draft(model + drawing, "the new gear pair");
  const double resonance = 1.5 * draft.scales.rpm_per_omega;
  const double fast = kFastest / (std::numbers::pi * gear.module_mm * 1e-3 * gear.teeth[0]) * 60.0;
  const double to = rounded(std::min(resonance, fast));
  return fmt::format(
             "# A gear pair of {0} and {1} teeth, module {2} mm. ESTIMATE marks what nobody gave:\n"
             "# put your own numbers there. Keys behind a # are others that a drawing may have.\n"
             "title = \"Gear pair {0}/{1}, module {2} mm\"\n",
             gear.teeth[0], gear.teeth[1], gear.module_mm) +
         model + drawing +
         fmt::format(
             "# Up to {}.\n[[axes]]\nname = \"pinion_speed_rpm\"\nfrom = {}\nto = {}\n"
             "count = 200\n[observe]\n"
             "quantities = [\"dmf_max\", \"dmf_min\", \"contact_class\", \"x1_rms\"]\n",
             resonance < fast ? "beyond the resonance of the teeth"
                              : fmt::format("a pitch-line velocity of {} m/s", kFastest),
             rounded(0.05 * to), to);
}

}  // namespace gearsweep
