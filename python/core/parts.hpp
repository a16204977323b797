// The parts of the module `gearsweep._core`, each of which adds its names.
#pragma once

#include <pybind11/pybind11.h>

namespace gearsweep::python {

// InputError, a ValueError, and RunError, a RuntimeError.
void add_errors(pybind11::module_* module);
// Study, and what is built in: studies and models.
void add_study(pybind11::module_* module);
void add_model(pybind11::module_* module);
// What accessors of results need: units of SI, and the colours and labels of pictures.
void add_picture(pybind11::module_* module);
// Session: devices, and runs on them.
void add_session(pybind11::module_* module);

}  // namespace gearsweep::python
