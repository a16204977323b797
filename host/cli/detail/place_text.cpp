#include "cli/detail/place_text.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>
#include <utility>

#include "model/error.hpp"
#include "point/point_orbit.hpp"

namespace gearsweep {
namespace {

// A finite number; `option` names what it was given for, in messages.
double to_number(const std::string& text, const std::string& option) {
  try {
    std::size_t used = 0;
    const double value = std::stod(text, &used);
    if (used == text.size() && std::isfinite(value)) return value;
  } catch (const std::logic_error&) {
    // Said below, with the rest of what is no number.
  }
  throw InputError(fmt::format("{}: '{}' is not a number", option, text));
}

// "name=rest" in two; `example` shows the form.
std::pair<std::string, std::string> split_assignment(const std::string& text,
                                                     const std::string& option,
                                                     const std::string& example) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0) {
    throw InputError(fmt::format("{}: '{}' is not of the form {}", option, text, example));
  }
  return {text.substr(0, equals), text.substr(equals + 1)};
}

}  // namespace

Place read_place(const Study& study, const std::vector<std::string>& at) {
  const std::string option = "--at";
  std::vector<NamedValue> values;
  for (const std::string& assignment : at) {
    const auto [name, text] = split_assignment(assignment, option, "omega=0.7");
    values.push_back({name, to_number(text, option)});
  }
  return find_place(study, values, option);
}

FollowedRange read_range(const Model& model, const std::string& text) {
  const std::string option = "--along", example = "omega=0.6:0.8";
  const auto [name, values] = split_assignment(text, option, example);
  const std::size_t colon = values.find(':');
  if (colon == std::string::npos) {
    throw InputError(fmt::format("{}: '{}' is not of the form {}", option, text, example));
  }
  return find_range(model, name, to_number(values.substr(0, colon), option),
                    to_number(values.substr(colon + 1), option), option);
}

}  // namespace gearsweep
