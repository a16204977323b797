#include "study/detail/gear_reader.hpp"

#include "model/names.hpp"
#include "study/builtin_models.hpp"
#include "study/detail/gear_files.hpp"
#include "study/detail/toml_access.hpp"

namespace gearsweep {
namespace {

void read_key(const toml::table& gear, const GearKey& key, TableReader* reader,
              GearDrawing* drawing) {
  const std::string name(key.name);
  if (key.is_measured()) {
    drawing->set_measured(key, read_measured(gear, key));
  } else if (key.form == KeyForm::word) {
    drawing->set_word(key, split_words(key.choices)[reader->choice(name, 0)]);
  } else if (key.form == KeyForm::number || !gear.get(name)->is_array()) {
    drawing->set_number(key, *reader->optional_number(name, key.min, key.max));
  } else {
    drawing->set_numbers(key, reader->numbers(name, key.min, key.max));
  }
}

}  // namespace

bool takes_drawing(const Model& model) {
  return model.name == kGearModel && model.text == *model_text(kGearModel);
}

const toml::node& node_of(const toml::table& gear, std::string_view key) {
  const toml::node* found = gear.get(key);
  return found == nullptr ? gear : *found;
}

GearDrawing read_drawing(const toml::table& gear, const GearValues& values) {
  TableReader reader(&gear, study_table("gear"));
  reader.refuse_unknown();
  GearDrawing drawing("[gear]");
  for (const GearKey& key : kGearKeys) {
    const auto value = values.find(key.name);
    // Of harmonics it is the first one alone.
    const bool is_replaced = value != values.end() && key.form != KeyForm::harmonics;
    try {
      if (gear.contains(key.name) && !is_replaced) read_key(gear, key, &reader, &drawing);
      if (value != values.end()) drawing.vary(key, value->second);
    } catch (const DrawingError& error) {
      fail_at(node_of(gear, key.name), error.what());
    }
  }
  return drawing;
}

GearConversion convert_gear(const GearDrawing& drawing, const Model& model,
                            const toml::table& gear) {
  try {
    return convert_gear(drawing, model);
  } catch (const DrawingError& error) {
    fail_at(node_of(gear, error.key()), error.what());
  }
}

}  // namespace gearsweep
