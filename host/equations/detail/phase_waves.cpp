#include "equations/detail/phase_waves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "expression/differentiate.hpp"
#include "expression/print.hpp"

namespace gearsweep {
namespace {

bool is_wave(Operation operation) {
  return operation == Operation::sine || operation == Operation::cosine ||
         operation == Operation::tangent;
}

bool is_whole(double factor) {
  constexpr double kRounding = 1e-9;
  return std::fabs(factor - std::round(factor)) <= kRounding * std::max(1.0, std::fabs(factor));
}

bool is_smooth(Operation operation) {
  switch (operation) {
    case Operation::absolute:
    case Operation::sign:
    case Operation::floor:
    case Operation::min:
    case Operation::max:
    case Operation::backlash:
    case Operation::stop:
    case Operation::select:
    case Operation::table:
      return false;
    default:
      return !is_condition(operation);
  }
}

bool contains(const std::vector<NodeId>& parts, NodeId id) {
  return std::ranges::binary_search(parts, id);
}

}  // namespace

PhaseWaves::PhaseWaves(ExpressionGraph* graph, const std::vector<NodeId>& inputs, NodeId phase,
                       const std::vector<NodeId>& roots) {
  std::map<NodeId, NodeId> in_next_period;
  for (const NodeId id : parts_of(*graph, roots)) {
    const Operation operation = (*graph)[id].operation;
    if (!is_wave(operation)) continue;
    const NodeId angle = (*graph)[id].arguments[0];
    const std::vector<NodeId> parts = parts_of(*graph, {angle});
    const bool grows = contains(parts, phase) && std::ranges::all_of(parts, [&](NodeId part) {
                         return is_smooth((*graph)[part].operation);
                       });
    if (!grows) continue;
    const NodeId factor = derivative(graph, angle, phase);
    if (contains(parts_of(*graph, {factor}), phase)) continue;
    if (graph->is_number(factor) && is_whole((*graph)[factor].number)) continue;
    const NodeId turn = graph->number(kWholePhase);
    const NodeId turns = graph->make(Operation::multiply, {turn, factor});
    const NodeId later = graph->make(Operation::add, {angle, turns});
    in_next_period[id] = graph->make(operation, {later});
    waves_.push_back({to_short_text(*graph, id), Tape(*graph, inputs, {factor})});
  }
  if (waves_.empty()) return;
  Rewriter rewrite(graph, std::move(in_next_period));
  std::vector<NodeId> given = inputs, values = roots;
  given.push_back(phase);
  for (const NodeId root : roots) values.push_back(rewrite(root));
  values_ = Tape(*graph, given, values);
  roots_ = roots.size();
}

// Whether a value differs between the periods, between two breaks.
bool PhaseWaves::is_read(const std::vector<double>& inputs, double from, double to) const {
  constexpr double kRounding = 1e-9;
  std::vector<double> given = inputs, values(2 * roots_);
  given.push_back(0.0);
  for (const double share : {0.19, 0.45, 0.83}) {
    given.back() = from + share * (to - from);
    values_.run(given.data(), values.data());
    for (std::size_t i = 0; i < roots_; ++i) {
      const double here = values[i], next = values[roots_ + i];
      const double size = std::max(std::fabs(here), std::fabs(next));
      if (std::fabs(here - next) > kRounding * size) return true;
    }
  }
  return false;
}

std::string PhaseWaves::check(const std::vector<double>& inputs, const PhaseBreaks& breaks) const {
  for (const Wave& wave : waves_) {
    const double factor = wave.factor.run(inputs);
    if (is_whole(factor)) continue;
    std::vector<double> bounds = breaks.find(inputs);
    bounds.insert(bounds.begin(), 0.0);
    bounds.push_back(kWholePhase);
    const bool is_read_at_begin = is_read(inputs, bounds[0], bounds[1]);
    if (!is_read_at_begin || !is_read(inputs, bounds[bounds.size() - 2], bounds.back())) {
      continue;
    }
    return fmt::format(
        "{} has {:.6g} waves in a period of the forcing and breaks off at its end, as the phase "
        "goes from 0 to 2*pi in each period: give it a whole number of waves; for a second "
        "frequency take a period that holds whole numbers of both waves, or a state of its own "
        "that grows with time",
        wave.text, std::fabs(factor));
  }
  return "";
}

}  // namespace gearsweep
