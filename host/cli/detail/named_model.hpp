// A model that a command is given: one that is built in, or a file.
#pragma once

#include <memory>
#include <string>

#include "model/model.hpp"

namespace gearsweep {

struct NamedModel {
  std::shared_ptr<const Model> model;
  std::string key;  // what [model] of a study calls it: "name = 'duffing'", "file = 'mine.toml'"
};

// What has a point or a slash in it is a path. Throws InputError, with the nearest name.
NamedModel named_model(const std::string& name_or_path);

}  // namespace gearsweep
