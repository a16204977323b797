#include "core/parts.hpp"
#include "model/error.hpp"

namespace gearsweep::python {

void add_errors(pybind11::module_* module) {
  pybind11::register_exception<InputError>(*module, "InputError", PyExc_ValueError);
  pybind11::register_exception<RunError>(*module, "RunError", PyExc_RuntimeError);
}

}  // namespace gearsweep::python
