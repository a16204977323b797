// The names of a model's file, of which each means one thing.
#pragma once

#include <toml++/toml.h>

#include <cstddef>
#include <set>
#include <string>

namespace gearsweep {

inline constexpr std::size_t kMaxModelNameLetters = 40;

// Up to 40 letters, digits and _, the first one a letter.
bool is_model_name(const std::string& text);

class ModelNames {
 public:
  // A new name of something that expressions may use. Throws InputError at the node's place.
  void take(const toml::node& node, const std::string& name);
  // One that expressions do not use, which may be a word of theirs.
  void take_outside(const toml::node& node, const std::string& name);

 private:
  std::set<std::string> taken_;
};

}  // namespace gearsweep
