// The built-in models: the files of kernels/models/, embedded in the binary.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "model/model.hpp"

namespace gearsweep {

// In the order of the alphabet. Files are read when they are asked for, all by models(); a model of
// models() and find_model() holds for points that differ in any parameter.
std::vector<std::string> model_names();
const std::vector<Model>& models();
// nullptr when there is none of that name.
const Model* find_model(std::string_view name);

// The text of one; nullptr when there is none of that name.
const std::string* model_text(std::string_view name);

// All texts, by file name, as in "duffing.toml".
const std::map<std::string, std::string>& model_texts();

}  // namespace gearsweep
