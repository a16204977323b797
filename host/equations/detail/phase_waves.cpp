#include "equations/detail/phase_waves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

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

// By how much an angle that grows steadily is more at the end of a period than at its beginning.
NodeId growth_of(ExpressionGraph* graph, NodeId angle, NodeId factor, const PhaseSymbols& symbols) {
  const NodeId whole = graph->number(kWholePhase), zero = graph->number(0.0);
  if (!contains(parts_of(*graph, {angle}), symbols.turn)) {
    return graph->make(Operation::multiply, {whole, factor});
  }
  const NodeId last = graph->make(Operation::subtract, {symbols.cycle, graph->number(1.0)});
  Rewriter at_begin(graph, {{symbols.phase, zero}, {symbols.turn, zero}});
  Rewriter at_end(graph, {{symbols.phase, whole}, {symbols.turn, last}});
  return graph->make(Operation::subtract, {at_end(angle), at_begin(angle)});
}

}  // namespace

PhaseWaves::PhaseWaves(ExpressionGraph* graph, const std::vector<NodeId>& inputs,
                       const PhaseSymbols& symbols, const std::vector<NodeId>& roots) {
  const NodeId phase = symbols.phase;
  std::vector<NodeId> given = inputs;
  given.push_back(symbols.turn);
  given.push_back(phase);
  // Each root as it is, and with what these are in the next period.
  const auto in_both_periods = [&](const std::map<NodeId, NodeId>& next) {
    Rewriter rewrite(graph, next);
    std::vector<NodeId> values;
    for (const NodeId root : roots) {
      values.push_back(root);
      values.push_back(rewrite(root));
    }
    return Tape(*graph, given, values);
  };
  std::map<NodeId, NodeId> all_next;
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
    const NodeId growth = growth_of(graph, angle, factor, symbols);
    const NodeId waves = graph->make(Operation::divide, {growth, graph->number(kWholePhase)});
    if (graph->is_number(waves) && is_whole((*graph)[waves].number)) continue;
    const NodeId later = graph->make(Operation::add, {angle, growth});
    const NodeId next = graph->make(operation, {later});
    all_next[id] = next;
    waves_.push_back(
        {to_short_text(*graph, id), Tape(*graph, inputs, {waves}), in_both_periods({{id, next}})});
  }
  if (waves_.empty()) return;
  cycle_ = Tape(*graph, inputs, {symbols.cycle});
  all_ = in_both_periods(all_next);
  roots_ = roots.size();
}

// Whether the value of some root differs between the periods at both ends of one.
bool PhaseWaves::breaks_off(const Tape& values, const Stretch& first, const Stretch& last) const {
  const std::vector<bool> at_begin = differ(values, first), at_end = differ(values, last);
  for (std::size_t i = 0; i < roots_; ++i) {
    if (at_begin[i] && at_end[i]) return true;
  }
  return false;
}

// Tells of each root whether its value differs between the periods.
std::vector<bool> PhaseWaves::differ(const Tape& values, const Stretch& stretch) const {
  constexpr double kRounding = 1e-9;
  std::vector<double> given = stretch.inputs, found(2 * roots_);
  std::vector<bool> out(roots_);
  given.push_back(0.0);
  for (const double share : {0.19, 0.45, 0.83}) {
    given.back() = stretch.from + share * (stretch.to - stretch.from);
    values.run(given.data(), found.data());
    for (std::size_t i = 0; i < roots_; ++i) {
      const double here = found[2 * i], next = found[2 * i + 1];
      const double size = std::max(std::fabs(here), std::fabs(next));
      if (std::fabs(here - next) > kRounding * size) out[i] = true;
    }
  }
  return out;
}

std::string PhaseWaves::check(const std::vector<double>& inputs, const PhaseBreaks& breaks) const {
  std::optional<Stretch> first, last;
  for (const Wave& wave : waves_) {
    const double factor = wave.factor.run(inputs);
    if (is_whole(factor)) continue;
    if (!first) {
      const auto in_turn = [&](double turn) {
        std::vector<double> turned = inputs;
        turned.push_back(turn);
        return turned;
      };
      const std::vector<double> begin = in_turn(0.0), end = in_turn(cycle_.run(inputs) - 1.0);
      const std::vector<double> early = breaks.find(begin), late = breaks.find(end);
      first = {begin, 0.0, early.empty() ? kWholePhase : early.front()};
      last = {end, late.empty() ? 0.0 : late.back(), kWholePhase};
    }
    if (!breaks_off(all_, *first, *last)) return "";
    if (!breaks_off(wave.values, *first, *last)) continue;
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
