#include "equations/detail/phase_waves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

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
  std::vector<NodeId> given = inputs;
  given.push_back(phase);
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
    Rewriter in_next_period(graph, {{id, graph->make(operation, {later})}});
    std::vector<NodeId> values;
    for (const NodeId root : roots) {
      if (!contains(parts_of(*graph, {root}), id)) continue;
      values.push_back(root);
      values.push_back(in_next_period(root));
    }
    waves_.push_back({to_short_text(*graph, id), Tape(*graph, inputs, {factor}),
                      Tape(*graph, given, values), values.size() / 2});
  }
}

// Of each root that has the wave, whether its value differs between the periods, between two
// breaks.
std::vector<bool> PhaseWaves::reads(const Wave& wave, const std::vector<double>& inputs,
                                    double from, double to) {
  constexpr double kRounding = 1e-9;
  std::vector<double> given = inputs, values(2 * wave.roots);
  std::vector<bool> out(wave.roots);
  given.push_back(0.0);
  for (const double share : {0.19, 0.45, 0.83}) {
    given.back() = from + share * (to - from);
    wave.values.run(given.data(), values.data());
    for (std::size_t i = 0; i < wave.roots; ++i) {
      const double here = values[2 * i], next = values[2 * i + 1];
      const double size = std::max(std::fabs(here), std::fabs(next));
      if (std::fabs(here - next) > kRounding * size) out[i] = true;
    }
  }
  return out;
}

std::string PhaseWaves::check(const std::vector<double>& inputs, const PhaseBreaks& breaks) const {
  std::vector<double> bounds;
  for (const Wave& wave : waves_) {
    const double factor = wave.factor.run(inputs);
    if (is_whole(factor)) continue;
    if (bounds.empty()) {
      bounds = breaks.find(inputs);
      bounds.insert(bounds.begin(), 0.0);
      bounds.push_back(kWholePhase);
    }
    const std::vector<bool> at_begin = reads(wave, inputs, bounds[0], bounds[1]);
    const std::vector<bool> at_end = reads(wave, inputs, bounds[bounds.size() - 2], bounds.back());
    bool is_read_at_both = false;
    for (std::size_t i = 0; i < wave.roots; ++i) is_read_at_both |= at_begin[i] && at_end[i];
    if (!is_read_at_both) continue;
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
