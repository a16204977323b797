// What a study that is refused is told.
#pragma once

#include <string>
#include <vector>

#include "model/error.hpp"
#include "study/model_file.hpp"
#include "study/study.hpp"

namespace gearsweep::testing {

// What is said of a file s.toml; empty when the study is accepted.
inline std::string refusal(const std::string& text, const std::vector<std::string>& overrides = {},
                           const std::vector<std::string>& zooms = {}) {
  try {
    read_study(text, "s.toml", overrides, zooms);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

// What is said of a model as a text; "accepted" when it is.
inline std::string refusal_of_model(const std::string& text) {
  try {
    read_model_text(text, "pair.toml");
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace gearsweep::testing
