// The built-in models: the files of zoo/, embedded in the binary.
#pragma once

#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "model/model.hpp"
#include "study/model_file.hpp"

namespace gearsweep {

// In the order of the alphabet. Files are read when they are asked for, all by models(); a model of
// models() and find_model() holds for points that differ in any parameter.
std::vector<std::string> model_names();
const std::vector<Model>& models();
// nullptr when there is none of that name.
const Model* find_model(std::string_view name);

// One for a study (read_model_text); nullptr when there is none of that name. The last ones are
// held for the studies that ask for the same.
std::shared_ptr<const Model> built_in_model(const std::string& name,
                                            const std::set<std::string>& swept,
                                            const ModelKeys& keys,
                                            const std::set<std::string>& promoted = {},
                                            const std::vector<SectionDefinition>& sections = {});

// The text of one; nullptr when there is none of that name.
const std::string* model_text(std::string_view name);

// All texts, by file name, as in "duffing.toml".
const std::map<std::string, std::string>& model_texts();

}  // namespace gearsweep
