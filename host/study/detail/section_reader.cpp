#include "study/detail/section_reader.hpp"

#include <fmt/format.h>

#include <string>

#include "study/detail/definition_entries.hpp"
#include "study/detail/model_names.hpp"
#include "study/detail/toml_access.hpp"

namespace gearsweep {
namespace {

SectionDefinition read_section(const Entry& entry) {
  const toml::table& row = table_of(entry, "when = \"x\", direction = \"down\"");
  TableReader reader(&row, fmt::format("section '{}'", entry.name));
  SectionDefinition section{entry.name, {}};
  const toml::node* place = nullptr;
  for (const char* const key : {"when", "maximum_of", "minimum_of"}) {
    const toml::node* node = reader.find(key);
    if (node == nullptr) continue;
    if (place != nullptr) {
      fail_at(*node, fmt::format("section '{}' is given twice: it has one of when, maximum_of and "
                                 "minimum_of",
                                 entry.name));
    }
    place = node;
    section.value = expression_of(*node, key);
    const std::string form = key;
    section.of_rate = form != "when";
    section.is_down = form == "maximum_of";
  }
  if (place == nullptr) {
    fail_at(row, fmt::format("section '{}' says not where it is: when = \"v\", or maximum_of = "
                             "\"x\", or minimum_of = \"x\"",
                             entry.name));
  }
  const toml::node* direction = reader.find("direction");
  if (direction != nullptr && section.of_rate) {
    fail_at(*direction, "a maximum or a minimum has no direction");
  }
  if (direction != nullptr) section.is_down = reader.choice("direction", 0, {"up", "down"}) == 1;
  reader.refuse_unknown();
  return section;
}

}  // namespace

std::vector<SectionDefinition> read_sections(const toml::table* table) {
  std::vector<SectionDefinition> sections;
  ModelNames names;
  for (const Entry& entry : entries_of(table)) {
    names.take_outside(*entry.node, entry.name);
    sections.push_back(read_section(entry));
  }
  return sections;
}

}  // namespace gearsweep
