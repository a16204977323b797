#include "model/model.hpp"

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <map>
#include <string>

#include "core/parts.hpp"
#include "gear/drawing_keys.hpp"
#include "model/error.hpp"
#include "model/names.hpp"
#include "study/builtin_models.hpp"
#include "study/model_file.hpp"
#include "study/table_file.hpp"

namespace gearsweep::python {
namespace {

namespace py = pybind11;

using Tables = std::map<std::string, std::string>;

py::tuple as_rows(const std::vector<ChannelInfo>& channels) {
  py::list rows;
  for (const ChannelInfo& channel : channels) {
    rows.append(py::make_tuple(channel.name, channel.unit, channel.meaning));
  }
  return py::tuple(rows);
}

// Rows of texts and numbers, which the package gives names.
py::dict as_dict(const Model& model, const Tables& tables) {
  py::list parameters, options, presets;
  for (const ParameterInfo& info : model.parameters) {
    parameters.append(
        py::make_tuple(info.name, info.unit, info.meaning, info.default_value, info.min, info.max));
  }
  for (const OptionInfo& info : model.options) {
    options.append(py::make_tuple(info.name, py::tuple(py::cast(info.choices)), info.meaning));
  }
  for (const PresetInfo& info : model.presets) {
    std::map<std::string, std::string> expressions;
    for (const auto& [name, expression] : info.expressions) expressions[name] = expression.text;
    presets.append(py::make_tuple(info.name, info.meaning, info.toml, expressions));
  }
  py::dict out;
  out["name"] = model.name;
  out["summary"] = model.summary;
  out["states"] = as_rows(model.states);
  out["signals"] = as_rows(model.signals);
  out["parameters"] = py::tuple(parameters);
  out["options"] = py::tuple(options);
  out["presets"] = py::tuple(presets);
  out["text"] = model.text;
  out["tables"] = tables;
  return out;
}

// The keys of the table [gear], as the package names their parts.
py::list gear_rows() {
  py::list rows;
  for (const GearKey& key : kGearKeys) {
    rows.append(py::make_tuple(key.name, key.unit(), key.meaning, key.fallback, key.min, key.max));
  }
  return rows;
}

py::dict builtin(const std::string& name) {
  const Model* model = find_model(name);
  if (model == nullptr) {
    throw InputError(fmt::format("unknown model '{}'{}", name, suggest_name(name, model_names())));
  }
  return as_dict(*model, {});
}

// A model with all the tables that it reads, as TablePoints finds them; none more.
py::dict read_with(const std::string& text, const std::string& source, const TablePoints& find) {
  Tables used;
  const std::shared_ptr<const Model> model =
      read_model_text(text, source, std::nullopt, [&](const std::string& name) {
        std::vector<TablePoint> points = find(name);
        used[name] = table_text(points);
        return points;
      });
  return as_dict(*model, used);
}

// tables: of text, by the names that table() gives them.
py::dict from_text(const std::string& text, const std::string& source, const Tables& tables) {
  std::vector<std::string> known;
  for (const auto& [name, points] : tables) known.push_back(name);
  py::dict read = read_with(text, source, [&](const std::string& name) {
    const auto found = tables.find(name);
    if (found == tables.end()) {
      throw InputError(
          fmt::format("the model reads the table '{}', which is not in tables={{...}}{}", name,
                      known.empty() ? "" : suggest_name(name, known)));
    }
    return parse_table(found->second, fmt::format("table '{}'", name));
  });
  const auto used = read["tables"].cast<Tables>();
  for (const std::string& name : known) {
    if (used.contains(name)) continue;
    throw InputError(fmt::format("table '{}' is read by no expression of the model", name));
  }
  return read;
}

py::dict from_file(const std::string& path) {
  return read_with(model_file_text(path), path, tables_beside(path));
}

}  // namespace

void add_model(py::module_* module) {
  module->def("model_names", &model_names);
  module->def("gear_keys", gear_rows);
  module->def("builtin_model", builtin);
  module->def("read_model", from_text);
  module->def("read_model_file", from_file);
}

}  // namespace gearsweep::python
