#include "study/study.hpp"

#include <algorithm>

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

bool Axis::sweeps_parameter() const {
  return std::ranges::any_of(swept(), [](const Swept& one) { return !one.is_state; });
}

Axis Axis::at(const std::vector<std::size_t>& places) const {
  Axis axis = *this;
  axis.values = chosen(values, places);
  for (Swept& column : axis.columns) column.values = chosen(column.values, places);
  return axis;
}

std::size_t Study::points() const {
  std::size_t count = 1;
  for (const Axis& axis : axes) count *= axis.values.size();
  return count;
}

std::vector<const Swept*> Study::swept() const {
  std::vector<const Swept*> all;
  for (const Axis& axis : axes) {
    for (const Swept& one : axis.swept()) all.push_back(&one);
  }
  return all;
}

const Swept* Study::find_swept(bool is_state, std::size_t index) const {
  const std::vector<const Swept*> all = swept();
  const auto found = std::ranges::find_if(
      all, [&](const Swept* one) { return one->is_state == is_state && one->index == index; });
  return found == all.end() ? nullptr : *found;
}

void Study::separate_points() {
  if (is_chained()) initial.policy = InitialPolicy::shifted;
  initial.ensemble = 1;
}

}  // namespace gearsweep
