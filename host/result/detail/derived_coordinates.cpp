#include "result/detail/derived_coordinates.hpp"

#include <algorithm>
#include <memory>

#include "plan/study_points.hpp"

namespace gearsweep {
namespace {

bool gives(const Axis& axis, const std::vector<std::size_t>& parameters) {
  return std::ranges::any_of(axis.swept(), [&](const Swept& swept) {
    return !swept.is_state && std::ranges::find(parameters, swept.index) != parameters.end();
  });
}

}  // namespace

std::vector<DerivedCoordinate> derived_coordinates(const Study& study) {
  std::vector<DerivedCoordinate> all;
  for (const DerivedParameter& derived : study.model->derived) {
    const ParameterInfo& info = study.model->parameters[derived.parameter];
    DerivedCoordinate one;
    one.parameter.name = info.name;
    one.parameter.unit = info.unit;
    one.parameter.meaning = info.meaning;
    one.parameter.index = derived.parameter;
    one.expression = derived.expression;
    for (std::size_t axis = 0; axis < study.axes.size(); ++axis) {
      if (gives(study.axes[axis], derived.from)) one.axes.push_back(axis);
    }
    if (!one.axes.empty()) all.push_back(std::move(one));
  }
  return all;
}

std::size_t size_of(const DerivedCoordinate& coordinate, const Study& study) {
  std::size_t size = 1;
  for (const std::size_t axis : coordinate.axes) size *= study.axes[axis].values.size();
  return size;
}

std::vector<double> values_of(const DerivedCoordinate& coordinate, const Study& study) {
  const StudyPoints points(std::shared_ptr<const Study>(std::shared_ptr<void>(), &study));
  // Along the second axis alone the points are a row apart.
  const bool is_along_y = coordinate.axes == std::vector<std::size_t>{1};
  const std::size_t stride = is_along_y ? study.axes.front().values.size() : 1;
  ModelSetting setting = study.setting;
  std::vector<double> values;
  for (std::size_t i = 0; i < size_of(coordinate, study); ++i) {
    points.set(i * stride, &setting);
    values.push_back(setting.parameters[coordinate.parameter.index]);
  }
  return values;
}

}  // namespace gearsweep
