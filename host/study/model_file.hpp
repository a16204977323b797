// A model's file: TOML with equations to a Model.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "equations/definition.hpp"
#include "model/model.hpp"

namespace gearsweep {

// The text of the file at `path`. Throws InputError.
std::string model_file_text(const std::string& path);

// The preset and the options that a study's [model] names.
using ModelKeys = std::map<std::string, std::string>;

// source: names the text in messages. swept: names in which the points of a study differ
// (ModelDefinition); all, if nothing is given. table_points: of the files that it names. keys: its
// options are chosen so; none is, if nothing is given. promoted: its constants of these names
// become parameters, where they are plain numbers. sections: beside its own. Throws InputError with
// the place.
std::shared_ptr<const Model> read_model_text(
    const std::string& text, const std::string& source,
    const std::optional<std::set<std::string>>& swept = std::nullopt,
    const TablePoints& table_points = {}, const std::optional<ModelKeys>& keys = std::nullopt,
    const std::set<std::string>& promoted = {},
    const std::vector<SectionDefinition>& sections = {});

}  // namespace gearsweep
