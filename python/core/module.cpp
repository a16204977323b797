// gearsweep._core: what Python calls of the library. The package `gearsweep` is its only user.
#include "core/parts.hpp"
#include "model/version.hpp"

PYBIND11_MODULE(_core, module) {
  module.doc() = "The library of gearsweep, for the package gearsweep alone.";
  gearsweep::python::add_errors(&module);
  gearsweep::python::add_study(&module);
  gearsweep::python::add_model(&module);
  gearsweep::python::add_picture(&module);
  gearsweep::python::add_session(&module);
  module.def("version", &gearsweep::version);
}
