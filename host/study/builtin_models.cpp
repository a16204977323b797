#include "study/builtin_models.hpp"

#include <algorithm>
#include <memory>
#include <mutex>

#include "study/model_file.hpp"

namespace gearsweep {

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

const std::string* model_text(std::string_view name) {
  const auto found = model_texts().find(std::string(name) + ".toml");
  return found == model_texts().end() ? nullptr : &found->second;
}

}  // namespace gearsweep
