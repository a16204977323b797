#include "core/result.hpp"

#include <pybind11/numpy.h>

#include <algorithm>

// Arrays are made of types that C++ has: of any other, pybind11 before 2.12 takes the size of an
// element from where NumPy 2 has something else, and the array is wrong without an error.
namespace gearsweep::python {
namespace {

namespace py = pybind11;

// As the NetCDF library for Python gives them: a list of one is a number.
py::object as_object(const std::string& text) { return py::str(text); }

template <typename T>
py::object as_scalar(T number) {
  return py::dtype::of<T>().attr("type")(number);
}

py::object as_object(double number) { return as_scalar(number); }
py::object as_object(float number) { return as_scalar(number); }

py::object as_object(const std::vector<signed char>& numbers) {
  if (numbers.size() == 1) return as_scalar(numbers.front());
  py::array_t<signed char> out(std::vector<std::size_t>{numbers.size()});
  std::ranges::copy(numbers, out.mutable_data());
  return out;
}

py::dict as_dict(const std::vector<Attribute>& attributes) {
  py::dict out;
  for (const Attribute& attribute : attributes) {
    out[py::str(attribute.name)] =
        std::visit([](const auto& value) { return as_object(value); }, attribute.value);
  }
  return out;
}

template <typename T>
py::array numbers_of(const DataVariable& variable, const std::vector<std::size_t>& shape) {
  py::array_t<T> out(shape);
  const std::span<T> elements(out.mutable_data(), static_cast<std::size_t>(out.size()));
  const py::gil_scoped_release others;
  variable.copy(0, elements);
  return out;
}

py::array letters_of(const DataVariable& variable, const std::vector<std::size_t>& shape) {
  // As wide as a letter, strides are those of letters.
  const py::array_t<signed char> letters(shape);
  py::array out = letters.attr("view")("S1");
  const auto& text = std::get<std::string>(variable.elements);
  std::copy(text.begin(), text.end(), static_cast<char*>(out.mutable_data()));
  return out;
}

py::array array_of(const DataVariable& variable, const std::vector<std::size_t>& shape) {
  switch (variable.stored) {
    case Stored::letter:
      return letters_of(variable, shape);
    case Stored::byte:
      return numbers_of<signed char>(variable, shape);
    case Stored::integer:
      return numbers_of<std::int32_t>(variable, shape);
    case Stored::single:
      return numbers_of<float>(variable, shape);
    case Stored::real:
      break;
  }
  return numbers_of<double>(variable, shape);
}

}  // namespace

py::tuple as_tuple(const Dataset& dataset) {
  py::list variables;
  for (const DataVariable& variable : dataset.variables) {
    py::list dimensions;
    for (const std::string& dimension : variable.dimensions) dimensions.append(dimension);
    variables.append(py::make_tuple(variable.name, py::tuple(dimensions),
                                    array_of(variable, dataset.shape_of(variable)),
                                    as_dict(variable.attributes)));
  }
  return py::make_tuple(variables, as_dict(dataset.attributes));
}

}  // namespace gearsweep::python
