#include "study/detail/curve_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>

#include "expression/periodic_table.hpp"
#include "model/error.hpp"
#include "model/names.hpp"
#include "study/detail/toml_access.hpp"
#include "study/table_file.hpp"

namespace gearsweep {
namespace {

const toml::table* curves_in(const toml::table& model) {
  const toml::node* node = model.get("curves");
  if (node == nullptr) return nullptr;
  if (!node->is_table()) {
    fail_at(*node, "curves must be a table: [model.curves] with NAME = \"file.csv\"");
  }
  return node->as_table();
}

// The name of the file, where it stands.
const toml::node& file_of(const std::string& name, const toml::node& curve) {
  const toml::node* file = curve.is_table() ? curve.as_table()->get("file") : &curve;
  if (file == nullptr || !file->is_string()) {
    fail_at(curve,
            fmt::format("the curve '{0}' needs a file: {0} = \"file.csv\", or {0} = {{ file = "
                        "\"file.csv\", interpolation = \"cubic\" }}",
                        name));
  }
  return *file;
}

Interpolation interpolation_of(const toml::node& curve) {
  if (!curve.is_table()) return Interpolation::linear;
  TableReader reader(curve.as_table(), "a curve");
  reader.know("file");
  const std::size_t chosen = reader.choice("interpolation", 0, {"linear", "cubic"});
  reader.refuse_unknown();
  return chosen == 1 ? Interpolation::cubic : Interpolation::linear;
}

}  // namespace

void take_in_curve_files(const StudyFiles& files, toml::table* root) {
  toml::table* model = (*root)["model"].as_table();
  if (model == nullptr) return;
  const toml::table* curves = curves_in(*model);
  if (curves == nullptr) return;
  toml::table tables;
  if (const toml::table* known = (*model)["tables"].as_table()) tables = *known;
  for (const auto& [key, node] : *curves) {
    const toml::node& file = file_of(std::string(key.str()), node);
    const std::string name = file.as_string()->get();
    if (tables.contains(name)) continue;
    try {
      tables.insert(name, table_text(read_table(files.path_of(file))));
    } catch (const InputError& error) {
      fail_at(file, error.what());
    }
  }
  model->insert_or_assign("tables", std::move(tables));
}

Curves read_given_curves(const toml::table* model, const Model& of) {
  const toml::table* given = model == nullptr ? nullptr : curves_in(*model);
  Curves curves;
  if (given == nullptr) return curves;
  const toml::table* tables = model->get("tables")->as_table();
  for (const auto& [key, node] : *given) {
    const std::string name(key.str());
    if (std::ranges::find(of.curves, name) == of.curves.end()) {
      fail_at(node, fmt::format("unknown curve '{}' of model '{}'{}", name, of.name,
                                suggest_name(name, of.curves)));
    }
    const toml::node& file = file_of(name, node);
    const std::string from = file.as_string()->get();
    try {
      const std::string source = fmt::format("'{}' in [model.tables]", from);
      curves[name] = std::make_shared<const PeriodicTable>(
          from, parse_table((*tables)[from].value_or(std::string()), source),
          interpolation_of(node));
    } catch (const InputError& error) {
      fail_at(file, error.what());
    }
  }
  return curves;
}

}  // namespace gearsweep
