#include "equations/detail/findings.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "equations/detail/state_jumps.hpp"
#include "expression/print.hpp"

namespace gearsweep {
namespace {

constexpr std::size_t kBreaksToSee = 8;

}  // namespace

std::string place_of(const SectionDefinition& section) {
  const std::string& value = section.value.text;
  if (section.of_rate) {
    return fmt::format("where {} is {}", value, section.is_down ? "largest" : "smallest");
  }
  return fmt::format("where {} goes {} through 0", value, section.is_down ? "down" : "up");
}

std::vector<std::string> findings_of(const ModelDefinition& definition, const Formula& formula,
                                     const Lowered& lowered, const PhaseBreaks& breaks) {
  std::vector<std::string> lines;
  const auto add = [&](const std::string& line) { lines.push_back(line); };
  const ExpressionGraph& graph = formula.graph;
  if (lowered.is_second_order) add("second order: positions, then their velocities");
  for (const StateJump& jump : state_jumps_of(definition, lowered.jumps)) {
    add(
        fmt::format("jumps with a state: {} (in {}); steps are of first order there, and there are "
                    "no exponents, periods and kinds of motion",
                    jump.expression, jump.place));
  }
  for (const Surface& surface : lowered.surfaces) {
    if (!surface.reset.empty()) {
      const auto defined =
          std::ranges::find(definition.surfaces, surface.name, &SurfaceDefinition::name);
      add(fmt::format("surface '{}': the state is reset where {} goes from below 0 to above it",
                      surface.name, defined->when.text));
      continue;
    }
    add(
        fmt::format("jumps with a state: {} (in {}); steps are cut there, and a motion that both "
                    "sides push towards it slides along it",
                    surface.place.expression, equation_of(definition, surface.place)));
  }
  for (const SectionDefinition& section : definition.sections) {
    add(fmt::format("section '{}': {}", section.name, place_of(section)));
  }
  for (const Contact& contact : lowered.contacts.list) {
    if (contact.is_hidden) {
      add(fmt::format("corner of {}: steps that cross it are corrected", contact.name));
      continue;
    }
    const std::string name = contact.name.empty() ? "" : fmt::format(" '{}'", contact.name);
    const bool has_slope = std::ranges::any_of(
        contact.direction, [&](NodeId id) { return !graph.is_number(id, 0.0); });
    add(fmt::format("{}{}: {}", contact.is_one_sided ? "stop" : "backlash", name,
                    has_slope ? "steps that cross its limits are corrected"
                              : "the force does not begin with a slope: steps are not corrected"));
  }
  for (const RoughPlace& place : lowered.uncorrected) {
    add(fmt::format("corner of {} (in {}): steps are not corrected, and of second order there",
                    place.expression, equation_of(definition, place)));
  }
  for (const std::string& line : breaks.tables_left_out()) add(line);
  return lines;
}

std::vector<std::string> phase_findings_of(const ModelDefinition& definition,
                                           const Formula& formula, const Lowered& lowered,
                                           const PhaseBreaks& breaks) {
  std::vector<std::string> lines;
  const auto add = [&](const std::string& line) { lines.push_back(line); };
  for (const NodeId id : lowered.coef_values) {
    add(fmt::format("tabulated over the phase: {}",
                    to_short_text(formula.graph, id, formula.names)));
  }
  const std::vector<std::string> texts = breaks.texts();
  for (std::size_t i = 0; i < texts.size() && i < kBreaksToSee; ++i) {
    add(fmt::format("steps end at the phases where this jumps or bends: {}", texts[i]));
  }
  if (texts.size() > kBreaksToSee) {
    add(fmt::format("steps end where {} other expressions jump or bend, too",
                    texts.size() - kBreaksToSee));
  }
  for (std::size_t i = 0; i < definition.parameters.size(); ++i) {
    if (!lowered.shapes_phase[i] || !formula.are_swept[i]) continue;
    add(fmt::format("'{}' cannot be parted from the phase: each of its values has a table",
                    definition.parameters[i].name));
  }
  return lines;
}

}  // namespace gearsweep
