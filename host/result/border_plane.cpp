#include "result/border_plane.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "expression/periodic_table.hpp"
#include "model/error.hpp"
#include "result/study_source.hpp"

namespace gearsweep {
namespace {

std::string axes_text(const Study& study) {
  std::string text;
  for (const Axis& axis : study.axes) text += (text.empty() ? "" : " and ") + axis.name;
  return text;
}

bool have_same_axes(const Study& a, const Study& b) {
  const auto has = [&](const Axis& axis) {
    return std::ranges::find(b.axes, axis.name, &Axis::name) != b.axes.end();
  };
  return a.axes.size() == b.axes.size() && std::ranges::all_of(a.axes, has);
}

bool is_on_axes(const Study& study, std::size_t parameter) {
  return study.find_on_axes(parameter) != nullptr;
}

// "e0 = 0.5", "omega = 0.1*speed"
std::string value_text(const Study& study, std::size_t parameter) {
  const DerivedParameter* derived = study.model->find_derived(parameter);
  const std::string& name = study.model->parameters[parameter].name;
  return derived != nullptr ? fmt::format("{} = {}", name, derived->expression)
                            : fmt::format("{} = {}", name, study.setting.parameters[parameter]);
}

bool have_same_value(const Study& a, const Study& b, std::size_t parameter) {
  const DerivedParameter* of_a = a.model->find_derived(parameter);
  const DerivedParameter* of_b = b.model->find_derived(parameter);
  if (of_a != nullptr && of_b != nullptr) return of_a->expression == of_b->expression;
  return of_a == of_b && a.setting.parameters[parameter] == b.setting.parameters[parameter];
}

// The first function of the phase that one study binds and the other does not, or has another
// table of.
std::optional<PlaneDifference> difference_of_tables(const Curves& a, const Curves& b) {
  const auto differs = [](const Curves& from, const Curves& to) -> std::optional<std::string> {
    for (const auto& [name, table] : from) {
      const auto found = to.find(name);
      if (found == to.end() || !table->is_same_curve(*found->second)) return name;
    }
    return std::nullopt;
  };
  std::optional<std::string> name = differs(a, b);
  if (!name) name = differs(b, a);
  if (!name) return std::nullopt;
  const auto told = [&](const Curves& own) {
    return own.contains(*name) ? fmt::format("of a '{}' of their own", *name)
                               : fmt::format("without a '{}'", *name);
  };
  return PlaneDifference{told(a), b.contains(*name) ? "of another" : told(b)};
}

}  // namespace

std::optional<PlaneDifference> plane_difference(const Study& curves, const Study& map) {
  const Model &a = *curves.model, &b = *map.model;
  if (a.name != b.name) {
    return PlaneDifference{fmt::format("of the model {}", a.name),
                           fmt::format("of the model {}", b.name)};
  }
  if (!have_same_axes(curves, map)) {
    return PlaneDifference{"over " + axes_text(curves), "over " + axes_text(map)};
  }
  if (a.text != b.text || !std::ranges::equal(a.parameters, b.parameters, {}, &ParameterInfo::name,
                                              &ParameterInfo::name)) {
    return PlaneDifference{fmt::format("of other equations or parameters of {}", a.name),
                           "of its own ones"};
  }
  for (std::size_t i = 0; i < a.options.size(); ++i) {
    const int own = curves.setting.options[i], other = map.setting.options[i];
    if (own == other) continue;
    const auto told = [&](int choice) {
      return fmt::format("of {} = {}", a.options[i].name,
                         a.options[i].choices.at(static_cast<std::size_t>(choice)));
    };
    return PlaneDifference{told(own), told(other)};
  }
  for (std::size_t i = 0; i < a.parameters.size(); ++i) {
    if (is_on_axes(curves, i) || have_same_value(curves, map, i)) continue;
    return PlaneDifference{"of " + value_text(curves, i), "of " + value_text(map, i)};
  }
  return difference_of_tables(a.binding.curves, b.binding.curves);
}

Study read_border_study(const std::string& path, const StoredCurves& stored) {
  Study study = read_result_study(path);
  require_own_study(path, study, stored);
  return study;
}

void require_own_study(const std::string& name, const Study& study, const StoredCurves& stored) {
  const std::array<std::string, 2> own = {stored.x, stored.y};
  if (!std::ranges::equal(own, study.axes, {}, {}, &Axis::name)) {
    throw InputError(fmt::format("'{}' has curves that are not of its own study", name));
  }
}

void require_plane(const std::string& origin, const Study& curves, const Study& map) {
  const std::optional<PlaneDifference> difference = plane_difference(curves, map);
  if (!difference) return;
  throw InputError(fmt::format("{}: its curves are {}, the map is {}", origin,
                               difference->of_curves, difference->of_map));
}

}  // namespace gearsweep
