#include "equations/detail/added_signals.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "equations/detail/findings.hpp"
#include "equations/detail/refusals.hpp"
#include "model/error.hpp"

namespace gearsweep {
namespace {

constexpr const char* kMaxima = "maxima";

// The unit of the first state that a node depends on.
std::string unit_of(const Formula& formula, const ModelDefinition& definition, NodeId id) {
  const std::vector<NodeId> parts = parts_of(formula.graph, {id});
  for (std::size_t i = 0; i < formula.states.size(); ++i) {
    const bool is_in = std::ranges::find(parts, formula.states[i]) != parts.end();
    if (is_in) return definition.states[i].unit;
  }
  return "1";
}

// what: it belongs to.
void refuse_taken(const ModelDefinition& definition, const std::string& name,
                  const std::string& what) {
  const auto is_taken = [&](const auto& infos) {
    return std::ranges::any_of(infos, [&](const auto& info) { return info.name == name; });
  };
  if (!is_taken(definition.states) && !is_taken(definition.signals)) return;
  throw InputError(fmt::format("{}: '{}' is what a signal of {} is called; take another name",
                               definition.period.file, name, what));
}

// The first surface that resets a state.
std::optional<std::size_t> find_reset(const Formula& formula, std::size_t state) {
  const auto found = std::ranges::find_if(formula.impacts, [&](const Formula::Impact& impact) {
    return impact.reset[state] != formula.states[state];
  });
  if (found == formula.impacts.end()) return std::nullopt;
  return static_cast<std::size_t>(found - formula.impacts.begin());
}

}  // namespace

bool add_own_section(ModelDefinition* definition, Formula* formula) {
  if (!definition->sections.empty() || has_phase(*formula)) return false;
  std::optional<std::size_t> state = definition->looked_at;
  for (std::size_t i = 0; i < definition->states.size() && !state; ++i) {
    const bool moves = !formula->graph.is_number(formula->equations[i], 0.0);
    if (!definition->are_angles[i] && (moves || find_reset(*formula, i))) state = i;
  }
  const auto add = [&](const std::string& name, const ExpressionText& text, NodeId value,
                       bool of_rate) {
    definition->sections.push_back({name, text, of_rate, true});
    formula->sections.push_back({value, of_rate, true});
  };
  const auto text_of = [&](const std::string& text) {
    return ExpressionText{text, definition->period.file};
  };
  if (state) {
    const std::string& name = definition->states[*state].name;
    const std::optional<std::size_t> reset = find_reset(*formula, *state);
    if (!reset) {
      add(kMaxima, text_of(name), formula->states[*state], true);
      return true;
    }
    const SurfaceDefinition& surface = definition->surfaces[*reset];
    add(surface.name, surface.when, formula->impacts[*reset].when, false);
    return false;
  }
  const auto angle = std::ranges::find(definition->are_angles, true);
  if (angle == definition->are_angles.end()) return false;
  const auto first = static_cast<std::size_t>(angle - definition->are_angles.begin());
  add(kMaxima, text_of(fmt::format("sin({})", definition->states[first].name)),
      formula->graph.make(Operation::sine, {formula->states[first]}), true);
  return true;
}

std::vector<SectionInfo> add_section_signals(const Formula& formula, ModelDefinition* definition) {
  std::vector<SectionInfo> sections;
  for (std::size_t i = 0; i < formula.sections.size(); ++i) {
    const std::string& name = definition->sections[i].name;
    const auto is_same = [&](const SectionInfo& section) { return section.name == name; };
    if (std::ranges::any_of(sections, is_same)) {
      throw InputError(fmt::format("{}: there are two sections '{}'",
                                   definition->sections[i].value.place(), name));
    }
    const std::string unit = definition->sections[i].of_rate
                                 ? "1"
                                 : unit_of(formula, *definition, formula.sections[i].value);
    const auto add = [&](const std::string& suffix, const std::string& signal_unit,
                         const std::string& meaning) {
      refuse_taken(*definition, name + suffix, fmt::format("section '{}'", name));
      ChannelInfo info{name + suffix, signal_unit, meaning};
      info.is_hidden = true;
      definition->signals.push_back(std::move(info));
      return definition->signals.size() - 1;
    };
    const std::size_t level = add("_level", unit, "what rises through 0 at the section");
    const std::size_t rate = add("_rate", "1", "rate of that");
    const std::size_t size = add("_size", unit, "what its terms come to without their signs");
    sections.push_back({name, place_of(definition->sections[i]), level, rate, size});
  }
  return sections;
}

std::vector<ContactInfo> add_contact_signals(const Formula& formula, ModelDefinition* definition,
                                             Lowered* lowered) {
  std::vector<ContactInfo> contacts;
  for (const Contact& contact : lowered->contacts.list) {
    if (contact.is_hidden) break;
    const std::string before = contact.name.empty() ? "" : contact.name + "_";
    const std::string unit = unit_of(formula, *definition, contact.deflection);
    const auto add = [&](const std::string& name, const std::string& meaning, NodeId id) {
      refuse_taken(*definition, before + name, "one of the model's contacts");
      definition->signals.push_back({before + name, unit, meaning});
      lowered->signals.push_back(id);
      return lowered->signals.size() - 1;
    };
    const bool is_stop = contact.is_one_sided;
    const std::size_t deflection =
        add("deflection", is_stop ? "what meets the stop" : "what the backlash is taken from",
            contact.deflection);
    const std::size_t backlash =
        add("backlash", is_stop ? "where the stop is" : "half of the backlash", contact.backlash);
    contacts.push_back({contact.name, deflection, backlash, is_stop});
  }
  return contacts;
}

}  // namespace gearsweep
