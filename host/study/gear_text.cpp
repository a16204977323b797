#include "study/gear_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>
#include <vector>

#include "gear/conversion.hpp"
#include "model/error.hpp"
#include "study/builtin_models.hpp"
#include "study/detail/gear_lines.hpp"
#include "study/draft.hpp"
#include "study/toml_text.hpp"

namespace gearsweep {
namespace {

std::vector<std::string> quantities_of(const std::string& model) {
  if (model == "planetary") {
    return {"dmf_s1_dynamic_load_factor",
            "dmf_r1_dynamic_load_factor",
            "dmf_s1_max",
            "dmf_r1_max",
            "sun1_contact_class",
            "bearing_sun_max"};
  }
  return {"dmf1_dynamic_load_factor", "dmf2_dynamic_load_factor", "dmf1_max", "dmf2_max",
          "first_contact_class",      "second_contact_class"};
}

// As the list of a drawing.
std::string guesses_of(const std::vector<UnitTextParameter>& parameters) {
  std::vector<std::string> names;
  for (const UnitTextParameter& one : parameters) {
    const bool is_guess = one.origin.find("ESTIMATE") != std::string::npos;
    if (is_guess && !one.is_default) names.push_back(fmt::format("  \"{}\"", one.name));
  }
  if (names.empty()) return "";
  return comment("what is estimated of these, for reports") +
         fmt::format("estimated = [\n{},\n]\n", fmt::join(names, ",\n"));
}

}  // namespace

std::string gear_text(GearText text, const std::string& source) {
  const Model& gear5 = *find_model("gear5");
  const TakesKey takes = [&](const GearKey& key) { return takes_key(gear5, "", key); };
  add_estimates(takes, &text);
  const std::string model = "[model]\nname = \"gear5\"\nbacklash = \"dynamic\"\n";
  const std::string drawing = drawing_table("gear", takes, text);
  const Study draft = read_draft(model + drawing, source);
  return comments(text.about) + fmt::format("title = {}\n", toml_quoted(text.title)) + model +
         drawing +
         (text.spectrum.empty()
              ? speed_axis("pinion_speed_rpm", text, draft.scales.rpm_per_omega, 200) +
                    "[observe]\nquantities = [\"dmf_max\", \"dmf_min\", \"contact_class\", "
                    "\"x1_rms\"]\n"
              : spectrum_table("", text));
}

std::string unit_text(UnitText text, const std::string& source) {
  constexpr int kSpeeds = 60;  // a period may be many mesh periods
  const Model& model = *find_model(text.model);
  std::string study = fmt::format("[model]\nname = {}\n", toml_quoted(text.model));
  for (const auto& [option, choice] : text.options) {
    study += fmt::format("{} = {}\n", option, toml_quoted(choice));
  }
  for (auto& [name, drawing] : text.drawings) {
    const std::string suffix = "_" + name;
    const TakesKey takes = [&](const GearKey& key) { return takes_key(model, suffix, key); };
    add_estimates(takes, &drawing);
    study += drawing_table("gear." + name, takes, drawing);
  }
  if (!text.parameters.empty()) study += "[parameters]\n";
  for (const UnitTextParameter& one : text.parameters) {
    study += comment(one.origin) +
             fmt::format("{}{} = {}\n", one.is_default ? "# " : "", one.name, one.value);
  }
  study += guesses_of(text.parameters);
  const Study draft = read_draft(study, source);
  const std::string wrong = draft.model->check(draft.setting);
  if (!wrong.empty()) throw InputError(fmt::format("{}: {}", source, wrong));
  const auto& [first, drawing] = text.drawings.front();
  std::vector<std::string> quantities;
  for (const std::string& name : quantities_of(text.model)) quantities.push_back(toml_quoted(name));
  const std::string head =
      comments(text.about) + fmt::format("title = {}\n", toml_quoted(text.title)) + study;
  if (!drawing.spectrum.empty()) return head + spectrum_table("_" + first, drawing);
  return head +
         speed_axis("pinion_speed_rpm_" + first, drawing, draft.scales.rpm_per_omega, kSpeeds) +
         fmt::format("[observe]\nquantities = [{}]\n", fmt::join(quantities, ", "));
}

}  // namespace gearsweep
