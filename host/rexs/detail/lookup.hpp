// Attributes of components as numbers in known units.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "rexs/detail/units.hpp"
#include "rexs/document.hpp"

namespace gearsweep {

// Whether a relation says what a bearing or a coupling stands between.
bool is_of_sides(const RexsRelation& relation);

// A document by what is asked of it. Notes, once each, what has no number or an unknown unit, and
// what was never asked for.
class RexsLookup {
 public:
  explicit RexsLookup(const RexsDocument& document);

  const RexsDocument& document() const { return document_; }
  const RexsComponent* component(std::string_view id) const;
  std::vector<const RexsComponent*> of_type(std::string_view type) const;
  // The relations that name a component.
  const std::vector<const RexsRelation*>& relations_of(const RexsComponent& component) const;
  // What stands in a relation of this type, or of the ordered one (ordered_assembly), with the
  // component, where it has `own_role`, in another of the roles, in the order of the file: parts of
  // a shaft, the material of a gear.
  std::vector<const RexsComponent*> related(const RexsComponent& component, std::string_view type,
                                            std::string_view own_role, std::string_view role) const;

  // The number of an attribute in the quantity's unit; nothing where there is none.
  std::optional<double> number(const RexsComponent& component, std::string_view attribute,
                               RexsQuantity quantity);
  // A list of one length; nothing where there is none.
  std::optional<std::vector<double>> numbers(const RexsComponent& component,
                                             std::string_view attribute, RexsQuantity quantity,
                                             std::size_t count);
  std::string text(const RexsComponent& component, std::string_view attribute) const;

  // Whether a coupling is closed: one that switches says so, of several gears for the first.
  bool is_closed(const RexsComponent& coupling);

  void note(std::string text);
  // "unit.rexs:12: shaft 12 (Input shaft)"
  std::string place(const RexsComponent& component) const;
  std::vector<std::string> take_notes() { return std::move(notes_); }

 private:
  const RexsDocument& document_;
  std::map<std::string_view, const RexsComponent*> components_;
  std::map<std::string_view, std::vector<const RexsRelation*>> relations_;
  std::set<std::string> noted_;
  std::vector<std::string> notes_;
};

}  // namespace gearsweep
