#include "study/model_file.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "model/error.hpp"
#include "model/regular_file.hpp"
#include "study/detail/answer_reader.hpp"
#include "study/detail/definition_reader.hpp"
#include "study/nesting.hpp"

namespace gearsweep {
namespace {

constexpr std::size_t kMaxBytes = 256 * 1024;

std::set<std::string> parameter_names(const ModelDefinition& definition) {
  std::set<std::string> names;
  for (const ParameterInfo& parameter : definition.parameters) names.insert(parameter.name);
  return names;
}

// The choices of a preset, and of the keys that a study gives. What is none of the model's is
// refused where the study is read.
std::vector<int> choices_of(const ModelDefinition& definition, const ModelKeys& keys) {
  ModelKeys all;
  const auto named = keys.find("preset");
  for (const PresetInfo& preset : definition.presets) {
    const bool is_first = &preset == &definition.presets.front();
    if (named == keys.end() ? !is_first : preset.name != named->second) continue;
    for (const auto& [key, node] : toml::parse(preset.toml)) {
      if (node.is_string()) all[std::string(key.str())] = node.as_string()->get();
    }
  }
  for (const auto& [name, choice] : keys) all[name] = choice;
  std::vector<int> choices;
  for (const OptionInfo& option : definition.options) {
    const auto given = all.find(option.name);
    const auto found = given == all.end() ? option.choices.end()
                                          : std::ranges::find(option.choices, given->second);
    const bool is_default = found == option.choices.end();
    choices.push_back(is_default ? 0 : static_cast<int>(found - option.choices.begin()));
  }
  return choices;
}

// Derived parameters alone: numbers are checked where they are read.
void check_defaults(const Model& model) {
  for (const DerivedParameter& derived : model.derived) {
    const ParameterInfo& info = model.parameters[derived.parameter];
    const double value = info.default_value;
    if (value >= info.min && value <= info.max && std::isfinite(value)) continue;
    throw InputError(fmt::format(
        "{}: {} = {} comes to {} with the values of the model's file; it must be finite and from "
        "{} to {}",
        derived.place, info.name, derived.expression, value, info.min, info.max));
  }
}

}  // namespace

std::string model_file_text(const std::string& path) {
  if (!has_regular_file(path, "a model")) {
    throw InputError(fmt::format("{}: there is no such file", path));
  }
  std::ifstream in(path, std::ios::binary);
  // One byte more tells that there are too many.
  std::string text(kMaxBytes + 1, '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (in.bad()) throw InputError(fmt::format("{}: cannot be read", path));
  text.resize(static_cast<std::size_t>(in.gcount()));
  return text;
}

std::shared_ptr<const Model> read_model_text(const std::string& text, const std::string& source,
                                             const std::optional<std::set<std::string>>& swept,
                                             const TablePoints& table_points,
                                             const std::optional<ModelKeys>& keys,
                                             const std::set<std::string>& promoted,
                                             const std::vector<SectionDefinition>& sections) {
  if (text.size() > kMaxBytes) {
    throw InputError(
        fmt::format("{}: too large for a model; at most {} bytes are possible", source, kMaxBytes));
  }
  if (text.find('\0') != std::string::npos) {
    throw InputError(fmt::format("{}: not a text file; a model is TOML text", source));
  }
  refuse_deep_keys(text, source);
  try {
    const toml::table root = toml::parse(text, source);
    ModelDefinition definition = read_definition(root, text, source, promoted);
    definition.swept = parameter_names(definition);
    if (swept) {
      std::erase_if(definition.swept, [&](const auto& name) { return !swept->contains(name); });
    }
    if (keys) definition.choices = choices_of(definition, *keys);
    definition.table_points = table_points;
    definition.sections.insert(definition.sections.end(), sections.begin(), sections.end());
    check_presets(definition);
    const auto model = std::make_shared<Model>(make_model(definition));
    check_defaults(*model);
    // They are told of the model as its file has it, without sections of a study.
    if (sections.empty()) model->answers = read_answers(root, *model);
    return model;
  } catch (const toml::parse_error& error) {
    throw InputError(fmt::format("{}:{}: not valid TOML: {}", source, error.source().begin.line,
                                 error.description()));
  }
}

}  // namespace gearsweep
