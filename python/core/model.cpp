#include "model/model.hpp"

#include <fmt/format.h>
#include <pybind11/stl.h>

#include "core/parts.hpp"
#include "model/error.hpp"
#include "model/names.hpp"
#include "study/builtin_models.hpp"

namespace gearsweep::python {
namespace {

namespace py = pybind11;

py::list as_rows(const std::vector<ChannelInfo>& channels) {
  py::list rows;
  for (const ChannelInfo& channel : channels) {
    rows.append(py::make_tuple(channel.name, channel.unit, channel.meaning));
  }
  return rows;
}

// Rows of texts and numbers, which the package gives names.
py::dict as_dict(const std::string& name) {
  const Model* model = find_model(name);
  if (model == nullptr) {
    throw InputError(fmt::format("unknown model '{}'{}", name, suggest_name(name, model_names())));
  }
  py::list parameters, options, presets;
  for (const ParameterInfo& info : model->parameters) {
    parameters.append(
        py::make_tuple(info.name, info.unit, info.meaning, info.default_value, info.min, info.max));
  }
  for (const OptionInfo& info : model->options) {
    options.append(py::make_tuple(info.name, py::tuple(py::cast(info.choices)), info.meaning));
  }
  for (const PresetInfo& info : model->presets) {
    presets.append(py::make_tuple(info.name, info.meaning));
  }
  py::dict out;
  out["name"] = model->name;
  out["summary"] = model->summary;
  out["states"] = as_rows(model->states);
  out["signals"] = as_rows(model->signals);
  out["parameters"] = parameters;
  out["options"] = options;
  out["presets"] = presets;
  return out;
}

}  // namespace

void add_model(py::module_* module) {
  module->def("model_names", &model_names);
  module->def("model", as_dict);
}

}  // namespace gearsweep::python
