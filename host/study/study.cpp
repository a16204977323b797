#include "study/study.hpp"

#include <algorithm>

#include "model/error.hpp"

namespace gearsweep {
namespace {

std::vector<double> chosen(const std::vector<double>& values,
                           const std::vector<std::size_t>& places) {
  std::vector<double> out;
  out.reserve(places.size());
  for (const std::size_t place : places) out.push_back(values[place]);
  return out;
}

}  // namespace

std::span<const Swept> Axis::swept() const {
  if (!columns.empty()) return columns;
  return {static_cast<const Swept*>(this), 1};
}

bool Axis::sweeps_state() const {
  return std::ranges::any_of(swept(), [](const Swept& one) { return one.is_state; });
}

const Swept* Axis::find_column(const std::string& column) const {
  for (const std::vector<Swept>* all : {&others, &columns}) {
    const auto found = std::ranges::find(*all, column, &Swept::name);
    if (found != all->end()) return &*found;
  }
  return nullptr;
}

Axis Axis::at(const std::vector<std::size_t>& places) const {
  Axis axis = *this;
  axis.values = chosen(values, places);
  for (std::vector<Swept>* all : {&axis.columns, &axis.others}) {
    for (Swept& column : *all) column.values = chosen(column.values, places);
  }
  return axis;
}

Axis resting_axis(const Study& study) {
  const std::vector<ParameterInfo>& parameters = study.model->parameters;
  std::size_t index = 0;
  const auto would_do = [&] {
    return !study.differs(index) && study.model->find_derived(index) == nullptr;
  };
  while (index < parameters.size() && !would_do()) ++index;
  if (index == parameters.size()) {
    throw InputError("each parameter of the model is uncertain or follows others: give an axis");
  }
  const ParameterInfo& info = parameters[index];
  Axis axis;
  axis.name = info.name;
  axis.unit = info.unit;
  axis.meaning = info.meaning;
  axis.index = index;
  axis.values = {study.setting.parameters[index]};
  return axis;
}

std::size_t Study::points() const {
  std::size_t count = 1;
  for (const Axis& axis : axes) count *= axis.values.size();
  return count;
}

std::size_t Study::axis_index(std::size_t axis, std::size_t point) const {
  const std::size_t nx = axes[0].values.size();
  return axis == 0 ? point % nx : point % points() / nx;
}

double Study::axis_value(std::size_t axis, std::size_t point) const {
  return axes[axis].values[axis_index(axis, point)];
}

const Swept* Study::find_on_axes(std::size_t parameter) const {
  for (const Axis& axis : axes) {
    for (const Swept& one : axis.swept()) {
      if (!one.is_state && one.index == parameter) return &one;
    }
  }
  return nullptr;
}

std::vector<const Swept*> Study::swept() const {
  std::vector<const Swept*> all;
  for (const Axis& axis : axes) {
    for (const Swept& one : axis.swept()) all.push_back(&one);
  }
  for (const UncertainParameter& parameter : uncertain.parameters) {
    for (const Swept& one : parameter.draws.swept()) {
      // A factor may belong to a parameter that an axis has.
      if (find_on_axes(one.index) == nullptr) all.push_back(&one);
    }
  }
  return all;
}

const Swept* Study::find_swept(bool is_state, std::size_t index) const {
  const std::vector<const Swept*> all = swept();
  const auto found = std::ranges::find_if(
      all, [&](const Swept* one) { return one->is_state == is_state && one->index == index; });
  return found == all.end() ? nullptr : *found;
}

bool Study::differs(std::size_t parameter) const {
  const auto is_swept = [this](std::size_t index) { return find_swept(false, index) != nullptr; };
  const DerivedParameter* const derived = model->find_derived(parameter);
  return is_swept(parameter) ||
         (derived != nullptr && std::ranges::any_of(derived->from, is_swept));
}

void Study::bind(const Binding& binding) {
  if (binding == model->binding) return;
  Model other = model->bound(binding);
  other.diverged_above = model->diverged_above;  // may be the study's own
  other.answers = model->answers;
  own_model = std::make_shared<const Model>(std::move(other));
  model = own_model.get();
}

void Study::release(std::size_t parameter) {
  expressions.erase(model->parameters[parameter].name);
  Binding binding = model->binding;
  binding.expressions = expressions;
  bind(binding);
}

std::size_t Study::stages() const {
  if (is_chained()) return axes[initial.along].values.size();
  return uncertain.draws() > 0 && uncertain.starts_at_nominal ? 2 : 1;
}

void Study::separate_points() {
  if (is_chained()) initial.policy = InitialPolicy::shifted;
  initial.ensemble = 1;
  take_nominal();
}

void Study::take_nominal() {
  uncertain = {};
  std::erase_if(selection.quantities, [](const Quantity& quantity) { return quantity.of_draws; });
}

std::size_t Uncertain::independent_draws() const { return sobol ? 2 * samples : samples; }

std::size_t Uncertain::draws() const {
  return independent_draws() + (sobol ? samples * parameters.size() : 0);
}

}  // namespace gearsweep
