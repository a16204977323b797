#include "study/detail/model_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>
#include <set>

#include "model/error.hpp"
#include "model/names.hpp"
#include "study/builtin_models.hpp"
#include "study/detail/definition_entries.hpp"
#include "study/detail/parameter_values.hpp"
#include "study/detail/section_reader.hpp"
#include "study/detail/toml_access.hpp"
#include "study/model_file.hpp"
#include "study/study_keys.hpp"
#include "study/table_file.hpp"

namespace gearsweep {
namespace {

// The numbers that the model reads from files become a part of the study, as its text does.
void take_in_tables(const std::string& text, const toml::node& named, const std::string& path,
                    toml::table* model) {
  if (const toml::node* node = model->get("tables")) {
    fail_at(*node, "tables belong to a model's text; with its file they are read beside it");
  }
  if (text.find("table") == std::string::npos) return;  // a model is read a second time for them
  toml::table tables;
  try {
    read_model_text(text, named.as_string()->get(), {},
                    [&, beside = tables_beside(path)](const std::string& table) {
                      std::vector<TablePoint> points = beside(table);
                      tables.insert_or_assign(table, table_text(points));
                      return points;
                    });
  } catch (const InputError& error) {
    fail_at(named, error.what());
  }
  if (!tables.empty()) model->insert("tables", std::move(tables));
}

// What a preset assigns: options, where points start, parameters.
void apply_preset(const PresetInfo& preset, Study* study) {
  const std::string origin = "preset " + preset.name;
  const toml::table table = toml::parse(preset.toml, origin);
  for (const auto& [key, node] : table) {
    const std::string name(key.str());
    if (name == "policy") {
      TableReader reader(&table, "[preset]");
      study->initial.policy = static_cast<InitialPolicy>(reader.choice(name, 0, policy_names()));
    } else if (const toml::table* state = node.as_table(); name == "state" && state != nullptr) {
      TableReader reader(state, "[preset.state]");
      for (std::size_t i = 0; i < study->model->states.size(); ++i) {
        study->initial.state[i] =
            reader.number(study->model->states[i].name, 0.0, -kMaxState, kMaxState);
      }
    } else if (const int option = study->model->find_option(name); option >= 0) {
      const auto index = static_cast<std::size_t>(option);
      TableReader reader(&table, "[preset]");
      study->setting.options[index] =
          static_cast<int>(reader.choice(name, 0, study->model->options[index].choices));
      study->option_origins[index] = origin;
    } else {
      give_parameter(node, name, origin, study);
    }
  }
  for (const auto& [name, text] : preset.expressions) {
    study->expressions[name] = text;
    study->parameter_origins[static_cast<std::size_t>(study->model->find_parameter(name))] = origin;
  }
}

// What differs from point to point, as it stands in the text: axes and tolerances are checked when
// the model is known.
std::set<std::string> axis_names(const toml::table& root) {
  std::set<std::string> names;
  if (const toml::array* columns = root["points"]["names"].as_array()) {
    for (const toml::node& column : *columns) names.insert(column.value_or(std::string()));
  }
  if (const toml::table* uncertain = root["uncertain"].as_table()) {
    for (const auto& [key, node] : *uncertain) names.insert(std::string(key.str()));
  }
  const toml::array* axes = root.contains("axes") ? root.get("axes")->as_array() : nullptr;
  if (axes == nullptr) return names;
  for (const toml::node& axis : *axes) {
    const toml::table* table = axis.as_table();
    const toml::node* name = table == nullptr ? nullptr : table->get("name");
    if (name != nullptr && name->is_string()) names.insert(name->as_string()->get());
  }
  return names;
}

// All that the study gives values to: a constant of the model among it becomes a parameter.
std::set<std::string> given_names(const toml::table& root) {
  std::set<std::string> names = axis_names(root);
  const toml::table* parameters = root["parameters"].as_table();
  if (parameters == nullptr) return names;
  for (const auto& [key, node] : *parameters) {
    const toml::array* list = node.as_array();
    const std::size_t count = list == nullptr ? 1 : std::min(list->size(), kMaxNames);
    for (std::size_t i = 0; i < count; ++i) {
      names.insert(name_in_list(std::string(key.str()), i));
    }
  }
  return names;
}

ModelKeys keys_of(const toml::table* model) {
  ModelKeys keys;
  if (model == nullptr) return keys;
  for (const auto& [key, node] : *model) {
    if (node.is_string()) keys[std::string(key.str())] = node.as_string()->get();
  }
  return keys;
}

// Whether the numbers of a file are those of a curve.
bool is_of_curve(const toml::table& root, const std::string& file) {
  const toml::table* curves = root["model"]["curves"].as_table();
  if (curves == nullptr) return false;
  return std::ranges::any_of(*curves, [&](const auto& entry) {
    const toml::node& curve = entry.second;
    const toml::node* named = curve.is_table() ? curve.as_table()->get("file") : &curve;
    return named != nullptr && named->value_or(std::string()) == file;
  });
}

// A model of the user's own, from the text that the study holds since the file was read.
void read_own_model(const toml::table& root, TableReader* reader, Study* study) {
  const std::string file = reader->text("file", "the study's model");
  if (reader->find("name") != nullptr) {
    fail_at(*reader->find("name"), "give the model's name or its file, not both");
  }
  const toml::table* tables = reader->table("tables");
  // The model keeps these: it may be bound anew when the study's text is gone.
  const auto texts = std::make_shared<std::map<std::string, std::string>>();
  const auto used = std::make_shared<std::set<std::string>>();
  if (tables != nullptr) {
    for (const auto& [key, node] : *tables) {
      if (!node.is_string()) fail_at(node, "a table must be a string of numbers, in quotes");
      texts->emplace(key.str(), node.as_string()->get());
    }
  }
  const TablePoints points_of = [texts, used](const std::string& table) {
    const auto found = texts->find(table);
    if (found == texts->end()) {
      throw InputError(fmt::format("'{}' is not in [model.tables] of the study", table));
    }
    used->insert(table);
    return parse_table(found->second, fmt::format("'{}' in [model.tables]", table));
  };
  try {
    study->own_model = read_model_text(reader->text("text", ""), file, axis_names(root), points_of,
                                       keys_of(root["model"].as_table()), given_names(root),
                                       read_sections(root["sections"].as_table()));
  } catch (const InputError& error) {
    // The name of the file alone does not tell where it lies.
    if (const toml::node* named = reader->find("file")) fail_at(*named, error.what());
    throw;
  }
  study->model = study->own_model.get();
  if (tables == nullptr) return;
  for (const auto& [key, node] : *tables) {
    if (used->contains(std::string(key.str())) || is_of_curve(root, std::string(key.str())))
      continue;
    fail_at(node, fmt::format("'{}' is read by no expression of the model", key.str()));
  }
}

// One of equations is read anew: what is tabulated depends on the study's axes.
void read_builtin_model(const toml::table& root, TableReader* reader, Study* study) {
  const std::string name = reader->text("name", kDefaultModel);
  study->own_model = built_in_model(name, axis_names(root), keys_of(root["model"].as_table()),
                                    given_names(root), read_sections(root["sections"].as_table()));
  study->model = study->own_model.get();
  if (study->model != nullptr) return;
  fail_at(*reader->find("name"),
          fmt::format("unknown model '{}'{}", name, suggest_name(name, model_names())));
}

}  // namespace

void read_model(const toml::table& root, const toml::table* table, Study* study) {
  TableReader reader(table, study_table("model"));
  if (const toml::node* text = reader.find("text");
      text != nullptr || reader.find("file") != nullptr) {
    read_own_model(root, &reader, study);
  } else {
    if (const toml::node* tables = reader.find("tables")) {
      if (!table->contains("curves")) {
        fail_at(*tables, "tables belong to the text of a model of your own, or to its curves");
      }
    }
    read_builtin_model(root, &reader, study);
  }
  reader.find("curves");  // read_given_curves(), once the rest of the study is known
  const Model& model = *study->model;
  study->setting = model.default_setting();
  study->expressions = model.binding.expressions;
  study->parameter_origins.assign(model.parameters.size(), "default");
  study->option_origins.assign(model.options.size(), "default");
  study->initial.state.assign(model.states.size(), 0.0);
  study->preset = model.presets.empty() ? "" : model.presets.front().name;
  const toml::node* const node = reader.find("preset");
  // The first one holds wherever none is named.
  if (node == nullptr && !model.presets.empty()) apply_preset(model.presets.front(), study);
  if (node != nullptr) {
    study->preset = reader.text("preset", "");
    const auto preset =
        std::find_if(model.presets.begin(), model.presets.end(),
                     [&](const PresetInfo& candidate) { return candidate.name == study->preset; });
    if (preset == model.presets.end()) {
      fail_at(*node, fmt::format("unknown preset '{}' of model '{}'{}", study->preset, model.name,
                                 suggest_name(study->preset, names_of(model.presets))));
    }
    study->parameter_origins.assign(model.parameters.size(), "preset " + study->preset);
    study->option_origins.assign(model.options.size(), "preset " + study->preset);
    apply_preset(*preset, study);
  }
  for (std::size_t i = 0; i < model.options.size(); ++i) {
    const OptionInfo& option = model.options[i];
    const toml::node* chosen = reader.find(option.name);
    if (chosen == nullptr) continue;
    study->setting.options[i] = static_cast<int>(reader.choice(option.name, 0, option.choices));
    study->option_origins[i] = place_of(*chosen);
  }
  reader.refuse_unknown();
}

void take_in_model_file(const StudyFiles& files, toml::table* root) {
  toml::table* model = root->contains("model") ? (*root)["model"].as_table() : nullptr;
  if (model == nullptr || !model->contains("file") || model->contains("text")) return;
  const toml::node& node = *model->get("file");
  if (!node.is_string()) fail_at(node, "file must be a string in quotes");
  const std::string path = files.path_of(node);
  std::string text;
  try {
    text = model_file_text(path);
  } catch (const InputError& error) {
    fail_at(node, error.what());
  }
  take_in_tables(text, node, path, model);
  model->insert("text", text);
}

}  // namespace gearsweep
