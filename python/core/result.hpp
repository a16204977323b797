// A result as Python's objects.
#pragma once

#include <pybind11/pybind11.h>

#include "result/dataset.hpp"

namespace gearsweep::python {

// ([(name, dimensions, array, attributes), ...], attributes): what the result's file would have, as
// it would have it. To be called with the GIL, which is let go while numbers are copied.
pybind11::tuple as_tuple(const Dataset& dataset);

}  // namespace gearsweep::python
