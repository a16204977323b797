#include <pybind11/stl.h>

#include "core/parts.hpp"
#include "model/names.hpp"
#include "result/study_source.hpp"
#include "study/draft.hpp"

namespace gearsweep::python {
namespace {

namespace py = pybind11;

std::vector<std::string> axis_names(const Study& study) {
  std::vector<std::string> names;
  for (const Axis& axis : study.axes) names.push_back(axis.name);
  return names;
}

std::vector<std::size_t> axis_counts(const Study& study) {
  std::vector<std::size_t> counts;
  for (const Axis& axis : study.axes) counts.push_back(axis.values.size());
  return counts;
}

}  // namespace

void add_study(py::module_* module) {
  py::class_<Study>(*module, "Study")
      .def_readonly("toml", &Study::toml)
      .def_readonly("title", &Study::title)
      .def_readonly("notices", &Study::notices)
      .def_property_readonly("model", [](const Study& study) { return study.model->name; })
      .def_property_readonly("option_names",
                             [](const Study& study) { return names_of(study.model->options); })
      .def_property_readonly("parameter_names",
                             [](const Study& study) { return names_of(study.model->parameters); })
      .def_property_readonly("axis_names", axis_names)
      .def_property_readonly("axis_counts", axis_counts);
  using Texts = std::vector<std::string>;
  module->def("read_study", [](const std::string& text, const std::string& source,
                               const Texts& changes) { return read_study(text, source, changes); });
  module->def("read_draft", [](const std::string& text, const std::string& source,
                               const Texts& changes) { return read_draft(text, source, changes); });
  // The GIL stays: while a file is read, no other thread of Python's must be at one.
  module->def("find_study", [](const std::string& name_or_path, const Texts& changes) {
    return find_study(name_or_path, changes);
  });
  module->def("builtin_study_names", &builtin_study_names);
}

}  // namespace gearsweep::python
