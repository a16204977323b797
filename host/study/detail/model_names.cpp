#include "study/detail/model_names.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "expression/expression.hpp"
#include "study/detail/toml_access.hpp"

namespace gearsweep {
namespace {

// Words of the grammar, and names that results have. Words of C are none: a kernel gives names of
// its own (kernel_name()).
const std::set<std::string, std::less<>>& reserved_words() {
  static const std::set<std::string, std::less<>> kWords = {
      "and",  "or",    "not",    "phase",      "pi",        "clamp",
      "step", "table", "status", "deflection", "at_surface"};
  return kWords;
}

}  // namespace

bool is_model_name(const std::string& text) {
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  return !text.empty() && text.size() <= kMaxModelNameLetters && is_letter(text.front()) &&
         std::ranges::all_of(
             text, [&](char c) { return is_letter(c) || c == '_' || (c >= '0' && c <= '9'); });
}

void ModelNames::take(const toml::node& node, const std::string& name) {
  take_outside(node, name);
  const auto function = std::ranges::find(functions(), name, &FunctionInfo::name);
  if (function != functions().end() || reserved_words().contains(name)) {
    fail_at(node, fmt::format("'{}' has a meaning of its own; take another name", name));
  }
}

void ModelNames::take_outside(const toml::node& node, const std::string& name) {
  if (!is_model_name(name)) {
    fail_at(node, fmt::format("'{}' cannot be a name; a name has up to {} letters, digits and _, "
                              "and begins with a letter",
                              name, kMaxModelNameLetters));
  }
  if (!taken_.insert(name).second) fail_at(node, fmt::format("'{}' is defined twice", name));
}

}  // namespace gearsweep
