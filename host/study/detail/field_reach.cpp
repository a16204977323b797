#include "study/detail/field_reach.hpp"

#include <algorithm>
#include <cmath>

namespace gearsweep {
namespace {

constexpr Interval kNo = {0.0, 0.0}, kYes = {1.0, 1.0}, kEither = {0.0, 1.0};

Interval min_of(const Interval& a, const Interval& b) {
  return {std::min(a.low, b.low), std::min(a.high, b.high)};
}
Interval max_of(const Interval& a, const Interval& b) {
  return {std::max(a.low, b.low), std::max(a.high, b.high)};
}
Interval hull(const Interval& a, const Interval& b) {
  return {std::min(a.low, b.low), std::max(a.high, b.high)};
}

double sign_of(double x) { return x > 0.0 ? 1.0 : x < 0.0 ? -1.0 : 0.0; }

}  // namespace

FieldReach::FieldReach(const Model& model, const ModelSetting& setting)
    : field_(field_of(model, setting.options)),
      parts_(parts_of(field_.graph, field_.rates)),
      values_(field_.graph.size()) {
  for (std::size_t i = 0; i < field_.parameters.size(); ++i) {
    const double value = setting.parameters[i];
    values_[field_.parameters[i]].value = {value, value};
  }
}

Interval FieldReach::value_of(const Node& node) const {
  const auto at = [&](std::size_t i) -> const Enclosure& { return values_[node.arguments[i]]; };
  const auto minus = [](const Interval& a, const Interval& b) {
    return enclose(Operation::subtract, {a, {}}, {b, {}}).value;
  };
  const auto plus = [](const Interval& a, const Interval& b) {
    return enclose(Operation::add, {a, {}}, {b, {}}).value;
  };
  const std::size_t count = node.arguments.size();
  const Interval a = count > 0 ? at(0).value : Interval{};
  const Interval b = count > 1 ? at(1).value : Interval{};
  switch (node.operation) {
    case Operation::number:
      return {node.number, node.number};
    case Operation::absolute:
      return a.contains(0.0) ? Interval{0.0, std::max(-a.low, a.high)}
                             : Interval{std::min(std::fabs(a.low), std::fabs(a.high)),
                                        std::max(std::fabs(a.low), std::fabs(a.high))};
    case Operation::sign:
      return {sign_of(a.low), sign_of(a.high)};
    case Operation::floor:
      return {std::floor(a.low), std::floor(a.high)};
    case Operation::min:
      return min_of(a, b);
    case Operation::max:
      return max_of(a, b);
    case Operation::stop:
      return max_of(minus(a, b), kNo);
    case Operation::backlash:
      return plus(max_of(minus(a, b), kNo), min_of(plus(a, b), kNo));
    case Operation::less:
      return a.high < b.low ? kYes : a.low >= b.high ? kNo : kEither;
    case Operation::less_or_equal:
      return a.high <= b.low ? kYes : a.low > b.high ? kNo : kEither;
    case Operation::equal:
      return a.high < b.low || b.high < a.low ? kNo : kEither;
    case Operation::conjunction:
      return min_of(a, b);
    case Operation::disjunction:
      return max_of(a, b);
    case Operation::negation:
      return {1.0 - a.high, 1.0 - a.low};
    case Operation::select:
      return a == kYes ? b : a == kNo ? at(2).value : hull(b, at(2).value);
    case Operation::table: {
      const PeriodicTable::Range range = node.table->range(a.low, a.high, 0.5 * (a.low + a.high));
      return {range.low, range.high};
    }
    default:
      return count > 1 ? enclose(node.operation, at(0), at(1)).value
                       : enclose(node.operation, at(0), at(0)).value;
  }
}

std::vector<double> FieldReach::rate_ranges(const std::vector<double>& low,
                                            const std::vector<double>& high) {
  for (std::size_t i = 0; i < field_.states.size(); ++i) {
    values_[field_.states[i]].value = {low[i], high[i]};
  }
  for (const NodeId id : parts_) {
    const Node& node = field_.graph[id];
    if (node.operation != Operation::symbol) values_[id].value = value_of(node);
  }
  std::vector<double> ranges;
  for (const NodeId rate : field_.rates) {
    ranges.push_back(values_[rate].value.high - values_[rate].value.low);
  }
  return ranges;
}

}  // namespace gearsweep
