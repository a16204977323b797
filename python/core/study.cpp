#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include "core/parts.hpp"
#include "model/names.hpp"
#include "result/result_file.hpp"
#include "result/study_source.hpp"
#include "study/as_built.hpp"
#include "study/draft.hpp"
#include "study/study_keys.hpp"

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

// A list of points: names with columns of one length, which the package has seen to.
using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Columns = std::vector<std::pair<std::string, Numbers>>;

PointTable table_of(const Columns& columns) {
  PointTable points;
  for (const auto& [name, numbers] : columns) {
    points.names.push_back(name);
    points.columns.emplace_back(numbers.data(), numbers.data() + numbers.size());
  }
  return points;
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
      // What a study may give as parameters, too: those that are plain numbers.
      .def_property_readonly("constant_names",
                             [](const Study& study) { return names_of(study.model->constants); })
      .def_property_readonly("trajectories", &Study::trajectories)
      .def_property_readonly("axis_names", axis_names)
      .def_property_readonly("axis_counts", axis_counts);
  using Texts = std::vector<std::string>;
  module->def("read_study", [](const std::string& text, const std::string& source,
                               const Texts& changes, const Columns& points) {
    return read_study(text, source, changes, {}, table_of(points));
  });
  // The text that a result holds.
  module->def("read_result_study", [](const std::string& text, const Texts& changes,
                                      const Columns& points) {
    return read_study(text, "study", changes, {}, table_of(points), NamedFiles::refused);
  });
  module->def("read_draft", [](const std::string& text, const std::string& source,
                               const Texts& changes, const Columns& points) {
    return read_draft(text, source, changes, table_of(points));
  });
  // The GIL stays: while a file is read, no other thread of Python's must be at one.
  module->def("find_study", [](const std::string& name_or_path, const Texts& changes) {
    return find_study(name_or_path, changes);
  });
  module->attr("MOST_AXIS_VALUES") =
      static_cast<std::size_t>(find_key(study_table("axes"), "count")->max);
  module->def("as_built",
              [](const Study& study, std::size_t gears, int tolerance_class, double percentile) {
                return as_built(study, {gears, tolerance_class, percentile}).study;
              });
  module->def("builtin_study_names", &builtin_study_names);
  module->def("is_netcdf", &is_netcdf);
  module->attr("MAX_ORBIT_STEPS") = static_cast<std::size_t>(kMaxOrbitSteps);
  py::class_<FoundStep>(*module, "FoundStep")
      .def(py::init([](double max_step, std::size_t orbit_steps) {
             return FoundStep{max_step, orbit_steps};
           }),
           py::arg("max_step"), py::arg("orbit_steps"));
  module->def("read_pilot_step", &read_pilot_step);
}

}  // namespace gearsweep::python
