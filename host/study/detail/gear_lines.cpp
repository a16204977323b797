#include "study/detail/gear_lines.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numbers>
#include <vector>

#include "study/toml_text.hpp"

namespace gearsweep {
namespace {

constexpr double kFastest = 50.0;  // pitch-line velocity, m/s

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

std::string line_of(const GearKey& key, const GearTextKeys& given) {
  const auto found = given.find(key.name);
  if (found == given.end()) return line_of_other(key);
  std::string text(key.meaning);
  const std::string& origin = found->second.origin;
  if (!origin.empty()) text += fmt::format("; {}", origin);
  if (origin.starts_with("ESTIMATE") && !key.advice.empty()) {
    text += fmt::format(". Better: {}", key.advice);
  }
  return comment(text) + fmt::format("{} = {}\n", key.name, found->second.value);
}

// A body is what masses are estimated by.
std::string estimates_of(const GearTextKeys& given) {
  std::vector<std::string> names;
  for (const GearKey& key : kGearKeys) {
    const auto found = given.find(key.name);
    const bool is_guess = found != given.end() && found->second.origin.starts_with("ESTIMATE");
    if (is_guess && key.name != kBody.name) names.push_back(fmt::format("  \"{}\"", key.name));
  }
  return comment("what is estimated, for reports: take out what you put your number at") +
         fmt::format("estimated = [\n{},\n]\n", fmt::join(names, ",\n"));
}

}  // namespace

std::string comment(std::string text) {
  for (char& letter : text) {
    if (static_cast<unsigned char>(letter) < 0x20U || letter == 0x7F) letter = '?';
  }
  constexpr std::size_t kWidth = 98;
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    std::size_t end = text.size();
    if (end - at > kWidth) {
      end = text.rfind(' ', at + kWidth);
      if (end == std::string::npos || end <= at) end = std::min(text.find(' ', at), text.size());
    }
    out += fmt::format("# {}\n", text.substr(at, end - at));
    at = end + 1;
  }
  return out;
}

std::string comments(std::string_view lines) {
  std::string text;
  while (!lines.empty()) {
    const std::size_t end = std::min(lines.find('\n'), lines.size());
    if (end > 0) text += comment(std::string(lines.substr(0, end)));
    lines.remove_prefix(std::min(end + 1, lines.size()));
  }
  return text;
}

double rounded(double value) {
  const double unit = std::pow(10.0, std::floor(std::log10(value)) - 1.0);
  return std::round(value / unit) * unit;
}

void add_estimates(const TakesKey& takes, GearText* text) {
  constexpr double kBearing = 2e5;     // N/mm
  constexpr double kDamping = 1e-5;    // s
  constexpr double kBacklash = 0.025;  // modules
  GearTextKeys& keys = text->keys;
  for (const GearKey& key : kGearKeys) {
    if (!takes(key)) keys.erase(key.name);
  }
  const auto add = [&](const GearKey& key, std::string value, const std::string& why) {
    if (takes(key)) keys.try_emplace(key.name, GearTextKey{std::move(value), "ESTIMATE: " + why});
  };
  const double width = text->face_width_mm.value_or(kEstimatedWidth * text->module_mm);
  if (!keys.contains(kMeshStiffness.name)) {
    add(kFaceWidth, fmt::format("{}", width), "ten modules");
  }
  if (!keys.contains(kMass.name) && !keys.contains(kInertia.name)) {
    add(kBody, "\"solid\"",
        fmt::format("steel discs without a bore, for {}inertia_kg_mm2",
                    takes(kMass) ? "mass_kg and " : ""));
  }
  add(kBearingStiffness, fmt::format("{}", kBearing), "that of two ball bearings");
  add(kBearingDamping, fmt::format("{}", kDamping * kBearing), "1e-5 s times their stiffness");
  add(kDampingRatio, "0.07", "between 0.03 and 0.17");
  add(kHalfBacklash, fmt::format("{}", kBacklash * text->module_mm), "0.025 modules");
  const double radius = 0.5 * text->module_mm * text->teeth[0];
  add(kTorque, fmt::format("{}", rounded(kEstimatedLoad * width * radius * 1e-3)),
      "100 N for each mm of the face width");
  const auto helix = keys.find(kHelix.name);
  if (helix == keys.end() || std::stod(helix->second.value) == 0.0) {
    add(kToothEntry, "\"gradual\"", "of involute tips without relief");
  }
  add(kTransmissionError, "5", "of ground teeth");
}

std::string drawing_table(const std::string& name, const TakesKey& takes, const GearText& text) {
  std::string lines = fmt::format("[{}]\n", name);
  for (const GearKey& key : kGearKeys) {
    if (takes(key)) lines += line_of(key, text.keys);
  }
  lines += estimates_of(text.keys);
  if (text.tables.empty()) return lines;
  lines += fmt::format("[{}.tables]\n", name);
  for (const auto& [file, numbers] : text.tables) {
    lines += fmt::format("{} = \"\"\"\n{}\"\"\"\n", toml_quoted(file), numbers);
  }
  return lines;
}

std::string speed_axis(const std::string& name, const GearText& text, double rpm_per_omega,
                       int count) {
  const double resonance = 1.5 * rpm_per_omega;
  const double fast = kFastest / (std::numbers::pi * text.module_mm * 1e-3 * text.teeth[0]) * 60.0;
  const double own = std::min(resonance, fast);
  const double to = rounded(std::max(own, 1.1 * text.fastest_rpm));
  const std::string why = own < 1.1 * text.fastest_rpm ? "beyond the fastest load case"
                          : resonance < fast
                              ? "beyond the resonance of the teeth"
                              : fmt::format("a pitch-line velocity of {} m/s", kFastest);
  return fmt::format("# Up to {}.\n[[axes]]\nname = \"{}\"\nfrom = {}\nto = {}\ncount = {}\n", why,
                     name, rounded(0.05 * to), to, count);
}

std::string spectrum_table(const std::string& suffix, const GearText& text) {
  std::string lines = fmt::format(
      "# A load spectrum: each load with its share of the time.\n[points]\n"
      "names = [\"torque_N_m{0}\", \"pinion_speed_rpm{0}\", \"time_share\"]\n"
      "numbers = \"\"\"\n",
      suffix);
  for (const GearTextLoad& one : text.spectrum) {
    lines += fmt::format("{:.10g}, {:.10g}, {:.10g}\n", one.torque, one.speed, one.share);
  }
  return lines + "\"\"\"\n";
}

}  // namespace gearsweep
