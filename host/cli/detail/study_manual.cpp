#include "cli/detail/study_manual.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/detail/roff.hpp"
#include "cli/detail/study_source.hpp"
#include "model/names.hpp"
#include "model/version.hpp"
#include "study/study_keys.hpp"

namespace gearsweep {
namespace {

constexpr const char* kStudyDescription =
    "A study says what gearsweep computes: a model with its parameters, one or two axes that are "
    "swept, where points start, how they are integrated, and what becomes a map.\n"
    "It is a TOML file. Only the axes are required.\n\n"
    "'gearsweep studies' lists the studies that are built in and prints one to start from.\n"
    "Each key may be overridden on the command line by its path, --set TABLE.KEY=VALUE, an axis by "
    "its name: --set axes.omega.count=40.\n"
    "A mistake is refused before anything is computed, with file, line and what would be right.\n\n"
    "'gearsweep model NAME' lists what depends on the model: its parameters with unit, range and "
    "meaning, its options, states, quantities and presets.";

constexpr const char* kOrder =
    "Of a parameter that is given more than once an axis wins over [parameters], [parameters] over "
    "[gear], [gear] over the preset, the preset over the model's default.";

// "From 1 to 1024." or "One of fp32, fp64."
std::string limits_of(const StudyKey& key) {
  if (!key.choices.empty()) return fmt::format(" One of {}.", fmt::join(key.choices, ", "));
  if (key.min == 0.0 && key.max == 0.0) return "";
  if (key.type == "string") return fmt::format(" At most {:g} characters.", key.max);
  return fmt::format(" From {:g} to {:g}.", key.min, key.max);
}

std::string default_of(const StudyKey& key) {
  if (key.fallback.empty()) return "";
  return key.fallback == "required" ? " Required." : fmt::format(" Default: {}.", key.fallback);
}

std::string key_text(const StudyKey& key) {
  const std::string name = key.is_pattern ? roff_italic(key.name) : roff_bold(key.name);
  return roff_item(fmt::format("{} ({})", name, roff_plain(key.type)),
                   roff_plain(key.meaning + limits_of(key) + default_of(key)));
}

std::string table_text(const StudyTable& table) {
  std::string text = fmt::format(
      ".SS {}\n", roff_plain(table.name.empty() ? "Before the first table" : table.heading));
  if (!table.name.empty() && !table.meaning.empty()) text += roff_plain(table.meaning) + "\n";
  for (const StudyKey& key : table.keys) text += key_text(key);
  return text;
}

// As an example stands in the text.
std::string indented(const std::string& text) {
  std::string out;
  for (const std::string& line : split(text, '\n')) {
    if (!line.empty()) out += "  " + line + "\n";
  }
  return out;
}

}  // namespace

std::string study_manual_page() {
  std::string text = fmt::format(
      ".TH GEARSWEEP\\-STUDY 5 \"\" \"gearsweep {}\" \"File Formats\"\n.SH NAME\n"
      "gearsweep\\-study \\- what gearsweep is to compute\n",
      version());
  text += roff_section("DESCRIPTION", roff_paragraphs(kStudyDescription));
  text += ".SH KEYS\n" + roff_plain(kOrder) + "\n";
  for (const StudyTable& table : study_tables()) text += table_text(table);
  text += roff_section("EXAMPLE", roff_paragraphs(indented(builtin_study_text("coarse-map"))));
  return text + ".SH SEE ALSO\n.BR gearsweep (1)\n";
}

}  // namespace gearsweep
