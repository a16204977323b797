#include "study/builtin_models.hpp"

#include <toml++/toml.h>

#include <algorithm>
#include <memory>
#include <mutex>
#include <tuple>

#include "model/names.hpp"

namespace gearsweep {

namespace {

// The names of its constants, which take no reading of the equations.
std::set<std::string> constants_of(const std::string& text) {
  std::set<std::string> names;
  const toml::table root = toml::parse(text);
  const toml::table* constants = root["constants"].as_table();
  if (constants == nullptr) return names;
  for (const auto& [key, node] : *constants) {
    const toml::array* list = node.as_array();
    const std::size_t count = list == nullptr ? 1 : list->size();
    for (std::size_t i = 0; i < count; ++i) {
      names.insert(name_in_list(std::string(key.str()), i));
    }
  }
  return names;
}

}  // namespace

std::vector<std::string> model_names() {
  std::vector<std::string> names;
  for (const auto& [file, text] : model_texts()) names.push_back(file.substr(0, file.find('.')));
  std::ranges::sort(names);
  return names;
}

const std::vector<Model>& models() {
  static const std::vector<Model> kAll = [] {
    std::vector<Model> list;
    for (const std::string& name : model_names()) list.push_back(*find_model(name));
    return list;
  }();
  return kAll;
}

const Model* find_model(std::string_view name) {
  const std::string* text = model_text(name);
  if (text == nullptr) return nullptr;
  static std::mutex mutex;
  static std::map<std::string, std::shared_ptr<const Model>, std::less<>> read;
  const std::lock_guard lock(mutex);
  auto known = read.find(name);
  if (known == read.end()) {
    const std::string own(name);
    known = read.emplace(own, read_model_text(*text, own + ".toml")).first;
  }
  return known->second.get();
}

std::shared_ptr<const Model> built_in_model(const std::string& name,
                                            const std::set<std::string>& swept,
                                            const ModelKeys& keys,
                                            const std::set<std::string>& promoted,
                                            const std::vector<SectionDefinition>& sections) {
  constexpr std::size_t kMany = 16;
  const std::string* text = model_text(name);
  if (text == nullptr) return nullptr;
  // Other names change nothing, and would make many of what is one.
  std::set<std::string> constants = constants_of(*text);
  std::erase_if(constants, [&](const std::string& one) { return !promoted.contains(one); });
  static std::mutex mutex;
  static std::map<std::tuple<std::string, std::set<std::string>, ModelKeys, std::set<std::string>,
                             std::vector<SectionDefinition>>,
                  std::shared_ptr<const Model>>
      held;
  const std::lock_guard lock(mutex);
  if (held.size() == kMany) held.clear();
  auto& model = held[{name, swept, keys, constants, sections}];
  if (model == nullptr) {
    model = read_model_text(*text, name + ".toml", swept, {}, keys, constants, sections);
  }
  return model;
}

const std::string* model_text(std::string_view name) {
  const auto found = model_texts().find(std::string(name) + ".toml");
  return found == model_texts().end() ? nullptr : &found->second;
}

}  // namespace gearsweep
