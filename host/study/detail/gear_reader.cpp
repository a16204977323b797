#include "study/detail/gear_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "model/names.hpp"
#include "study/builtin_models.hpp"
#include "study/detail/gear_files.hpp"
#include "study/detail/toml_access.hpp"

namespace gearsweep {
namespace {

constexpr const char* kGearModel = "gear5";

void read_key(const toml::table& gear, const GearKey& key, TableReader* reader,
              GearDrawing* drawing) {
  const std::string name(key.name);
  if (key.is_measured()) {
    drawing->set_measured(key, read_measured(gear, key));
  } else if (key.form == KeyForm::word) {
    const std::vector<std::string> choices = split_words(key.choices);
    drawing->set_word(key, choices[reader->choice(name, 0, choices)]);
  } else if (key.form == KeyForm::number || !gear.get(name)->is_array()) {
    drawing->set_number(key, *reader->optional_number(name, key.min, key.max));
  } else {
    drawing->set_numbers(key, reader->numbers(name, key.min, key.max));
  }
}

// What is called by these names elsewhere, and how it is given here.
constexpr std::pair<std::string_view, std::string_view> kElsewhere[] = {
    {"tip_relief_file",
     "profile_deviation_file has what relief takes away from both flanks, over the path of "
     "contact"},
    {"load_spectrum_file",
     "[points] file is a list of loads, with columns such as torque_N_m, pinion_speed_rpm and "
     "time_share"},
};

void refuse_other_words(const toml::table& table) {
  for (const auto& [word, instead] : kElsewhere) {
    const toml::node* const node = table.get(word);
    if (node != nullptr) fail_at(*node, fmt::format("there is no key '{}': {}", word, instead));
  }
}

// The names of the keys that are guesses. One that is gone, because something else stands in its
// place now, is none any more.
void read_estimated(const toml::table& gear, GearDrawing* drawing) {
  const toml::node* const node = gear.get(kEstimated);
  if (node == nullptr) return;
  const std::string right =
      fmt::format("{} is a list of keys of the table, as in [\"{}\"]", kEstimated, kTorque.name);
  const toml::array* const names = node->as_array();
  if (names == nullptr) fail_at(*node, right);
  for (const toml::node& name : *names) {
    const std::string text = name.value_or(std::string());
    const auto key = std::ranges::find(kGearKeys, text, &GearKey::name);
    if (key == std::end(kGearKeys)) fail_at(name, fmt::format("{}, and '{}' is none", right, text));
    if (gear.contains(text)) drawing->set_estimated(*key);
  }
}

}  // namespace

std::vector<DrawingTable> drawing_tables(const toml::table& study, const Model& model) {
  const toml::table* gear = study["gear"].as_table();
  // Another model may have the same name.
  if (model.name == kGearModel && model.text == *model_text(kGearModel)) {
    return {{"[gear]", "", gear}};
  }
  if (gear != nullptr && model.drawings.empty()) {
    fail_at(*gear, fmt::format("a [gear] table belongs to model '{}'", kGearModel));
  }
  TableReader reader(gear, "[gear]");
  std::vector<DrawingTable> tables;
  for (const std::string& name : model.drawings) {
    tables.push_back({fmt::format("[gear.{}]", name), "_" + name, reader.table(name)});
  }
  reader.refuse_unknown();
  return tables;
}

std::string member_name(const GearKey& key, std::size_t member) {
  return (member == 0 ? "pinion_" : "gear_") + std::string(key.name);
}

const toml::node& node_of(const DrawingTable& from, std::string_view key) {
  const toml::node* found = from.table->get(key);
  return found == nullptr ? *from.table : *found;
}

GearDrawing read_drawing(const DrawingTable& from, const GearValues& values) {
  const toml::table& table = *from.table;
  TableReader reader(&table, from.heading);
  refuse_other_words(table);
  for (const StudyKey& key : study_table("gear").keys) reader.know(key.name);
  reader.refuse_unknown();
  GearDrawing drawing(from.heading);
  for (const GearKey& key : kGearKeys) {
    const auto value = values.find(key.name);
    // It replaces the first of harmonics alone; the half backlash is the unit of length besides.
    const bool is_replaced =
        value != values.end() && key.form != KeyForm::harmonics && key.name != kHalfBacklash.name;
    try {
      if (table.contains(key.name) && !is_replaced) read_key(table, key, &reader, &drawing);
      if (value != values.end()) drawing.vary(key, value->second);
      for (std::size_t i = 0; key.form == KeyForm::pair && i < key.count(); ++i) {
        const auto member = values.find(member_name(key, i));
        if (member != values.end()) drawing.vary(key, member->second, i);
      }
    } catch (const DrawingError& error) {
      fail_at(node_of(from, key.name), error.what());
    }
  }
  read_estimated(table, &drawing);
  return drawing;
}

GearConversion convert_gear(const GearDrawing& drawing, const Model& model,
                            const DrawingTable& from, GearTexts texts) {
  try {
    return convert_gear(drawing, model, from.suffix, texts);
  } catch (const DrawingError& error) {
    fail_at(node_of(from, error.key()), error.what());
  }
}

}  // namespace gearsweep
