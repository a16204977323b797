#include "rexs/detail/lookup.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gearsweep {
namespace {

bool is_of_type(const RexsRelation& relation, std::string_view type) {
  constexpr std::string_view kOrdered = "ordered_";
  const std::string_view own = relation.type;
  return own == type || (own.starts_with(kOrdered) && own.substr(kOrdered.size()) == type);
}

}  // namespace

bool is_of_sides(const RexsRelation& relation) {
  return relation.type == "side" || relation.type == "connection" || relation.type == "contact";
}

RexsLookup::RexsLookup(const RexsDocument& document) : document_(document) {
  for (const RexsComponent& component : document.components) {
    components_[component.id] = &component;
  }
  for (const RexsRelation& relation : document.relations) {
    std::set<std::string_view> told;
    for (const RexsReference& reference : relation.references) {
      if (told.insert(reference.component).second) {
        relations_[reference.component].push_back(&relation);
      }
    }
  }
}

const RexsComponent* RexsLookup::component(std::string_view id) const {
  const auto found = components_.find(id);
  return found == components_.end() ? nullptr : found->second;
}

std::vector<const RexsComponent*> RexsLookup::of_type(std::string_view type) const {
  std::vector<const RexsComponent*> found;
  for (const RexsComponent& component : document_.components) {
    if (component.type == type) found.push_back(&component);
  }
  return found;
}

const std::vector<const RexsRelation*>& RexsLookup::relations_of(
    const RexsComponent& component) const {
  static const std::vector<const RexsRelation*> kNone;
  const auto found = relations_.find(component.id);
  return found == relations_.end() ? kNone : found->second;
}

std::vector<const RexsComponent*> RexsLookup::related(const RexsComponent& component,
                                                      std::string_view type,
                                                      std::string_view own_role,
                                                      std::string_view role) const {
  std::vector<const RexsComponent*> found;
  for (const RexsRelation* relation : relations_of(component)) {
    if (!is_of_type(*relation, type) || relation->of_role(own_role) != component.id) continue;
    for (const RexsReference& reference : relation->references) {
      if (reference.role == role && reference.component != component.id) {
        found.push_back(this->component(reference.component));
      }
    }
  }
  return found;
}

std::optional<double> RexsLookup::number(const RexsComponent& component, std::string_view attribute,
                                         RexsQuantity quantity) {
  const std::optional<std::vector<double>> one = numbers(component, attribute, quantity, 1);
  return one ? std::optional(one->front()) : std::nullopt;
}

std::optional<std::vector<double>> RexsLookup::numbers(const RexsComponent& component,
                                                       std::string_view attribute,
                                                       RexsQuantity quantity, std::size_t count) {
  const RexsAttribute* found = component.find(attribute);
  if (found == nullptr) return std::nullopt;
  const std::string where =
      fmt::format("{}: {} of {}", document_.place(found->line), attribute, component.label());
  if (found->numbers.size() != count) {
    const bool is_unknown = found->text.empty() || found->text == "NaN" || found->text == "nan";
    if (!is_unknown || !found->numbers.empty()) {
      note(fmt::format("{} is no {}: '{}'; not taken", where,
                       count == 1 ? "number" : fmt::format("list of {} numbers", count),
                       found->text));
    }
    return std::nullopt;
  }
  const std::optional<double> factor = rexs_unit(quantity, found->unit);
  if (!factor) {
    note(fmt::format("{} has the unit '{}', which is none of {}; not taken", where, found->unit,
                     fmt::join(unit_names(quantity), ", ")));
    return std::nullopt;
  }
  std::vector<double> numbers = found->numbers;
  for (double& number : numbers) number *= *factor;
  return numbers;
}

std::string RexsLookup::text(const RexsComponent& component, std::string_view attribute) const {
  const RexsAttribute* found = component.find(attribute);
  return found == nullptr ? "" : found->text;
}

bool RexsLookup::is_closed(const RexsComponent& coupling) {
  if (coupling.type == "coupling") return true;
  const std::string engaged = text(coupling, "is_engaged");
  if (engaged.find(' ') != std::string::npos) {
    note(fmt::format("{}: is_engaged has several gears, '{}'; the first is taken", place(coupling),
                     engaged));
  }
  return engaged.starts_with("true");
}

void RexsLookup::note(std::string text) {
  if (noted_.insert(text).second) notes_.push_back(std::move(text));
}

std::string RexsLookup::place(const RexsComponent& component) const {
  return fmt::format("{}: {}", document_.place(component.line), component.label());
}

}  // namespace gearsweep
