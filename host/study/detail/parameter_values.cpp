#include "study/detail/parameter_values.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <string_view>

#include "model/names.hpp"
#include "study/detail/definition_entries.hpp"
#include "study/detail/swept_name.hpp"
#include "study/detail/toml_access.hpp"

namespace gearsweep {
namespace {

constexpr std::string_view kGuesses = "estimated";

void give_one(const toml::node& node, const std::string& name, const std::string& origin,
              Study* study) {
  const Model& model = *study->model;
  const int found = model.find_parameter(name);
  if (found < 0) {
    refuse_fixed_constant(model, node, name);
    fail_at(node, fmt::format("unknown parameter '{}' of model '{}'{}", name, model.name,
                              suggest_name(name, names_of(model.parameters))));
  }
  const auto index = static_cast<std::size_t>(found);
  const ParameterInfo& info = model.parameters[index];
  study->parameter_origins[index] = origin;
  if (std::optional<ExpressionText> derivation = derivation_in(node)) {
    study->expressions[name] = *std::move(derivation);
    return;
  }
  if (!node.is_number()) {
    fail_at(node, fmt::format("{} must be a number, or an expression of other parameters in quotes",
                              name));
  }
  study->setting.parameters[index] = read_number(node, name, info.min, info.max);
  study->expressions.erase(name);
}

// Marks the parameters whose values are guesses. One that is not given any more is none.
void read_guesses(const toml::table& parameters, const toml::node& node, Study* study) {
  const std::string right =
      fmt::format("{} is a list of parameters that the table gives, as in [\"{}\"]", kGuesses,
                  study->model->parameters.front().name);
  const toml::array* const names = node.as_array();
  if (names == nullptr) fail_at(node, right);
  for (const toml::node& name : *names) {
    const std::string text = name.value_or(std::string());
    const int index = study->model->find_parameter(text);
    if (index < 0) fail_at(name, fmt::format("{}, and '{}' is none", right, text));
    if (!parameters.contains(text)) continue;
    std::string& origin = study->parameter_origins[static_cast<std::size_t>(index)];
    origin = fmt::format("{}, {}", kEstimatedOrigin, origin);
  }
}

}  // namespace

void give_parameter(const toml::node& node, const std::string& name, const std::string& origin,
                    Study* study) {
  const toml::array* list = node.as_array();
  if (list == nullptr) {
    give_one(node, name, origin, study);
    return;
  }
  for (std::size_t i = 0; i < list->size(); ++i) {
    const std::string element = name_in_list(name, i);
    if (study->model->find_parameter(element) < 0 && study->model->find_parameter(name) >= 0) {
      fail_at(node, fmt::format("parameter '{}' takes at most {} numbers", name, i));
    }
    give_one((*list)[i], element, origin, study);
  }
}

void read_parameters(const toml::table* table, Study* study) {
  if (table == nullptr) return;
  // A model may have a parameter of this name.
  const bool has_guesses =
      table->contains(kGuesses) && study->model->find_parameter(std::string(kGuesses)) < 0;
  for (const auto& [key, node] : *table) {
    if (has_guesses && key == kGuesses) continue;
    give_parameter(node, std::string(key.str()), place_of(node), study);
  }
  if (has_guesses) read_guesses(*table, *table->get(kGuesses), study);
}

void bind_expressions(Study* study) {
  for (const Axis& axis : study->axes) {
    for (const Swept& swept : axis.swept()) {
      if (!swept.is_state) study->expressions.erase(swept.name);
    }
  }
  Binding binding = study->model->binding;
  binding.expressions = study->expressions;
  study->bind(binding);
  study->model->derive(&study->setting);
}

void take_nominal_of_expression(const toml::node& place, std::size_t parameter, Study* study) {
  const Model& model = *study->model;
  const DerivedParameter* const derived = model.find_derived(parameter);
  if (derived == nullptr) return;
  const ParameterInfo& info = model.parameters[parameter];
  for (const std::size_t from : derived->from) {
    if (study->find_on_axes(from) == nullptr) continue;
    const std::string& other = model.parameters[from].name;
    fail_at(place, fmt::format("{0} = {1} ({2}) follows '{3}', which an axis gives, so it has no "
                               "one nominal value to draw around: give {0} a number in "
                               "[parameters], or a tolerance to {3}",
                               info.name, derived->expression, derived->place, other));
  }
  const double nominal = study->setting.parameters[parameter];
  if (!(nominal >= info.min && nominal <= info.max)) {
    fail_at(place, fmt::format("{} = {} ({}) comes to {}, out of range; from {} to {} is allowed",
                               info.name, derived->expression, derived->place, nominal, info.min,
                               info.max));
  }
  study->release(parameter);
}

}  // namespace gearsweep
