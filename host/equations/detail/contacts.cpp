#include "equations/detail/contacts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "expression/differentiate.hpp"

namespace gearsweep {
namespace {

class ContactFinder {
 public:
  ContactFinder(Formula* formula, const std::vector<NodeId>& equations)
      : formula_(formula), graph_(&formula->graph), equations_(equations) {}

  Contacts run(const std::map<NodeId, std::string>& names, const std::vector<Contact>& hidden) {
    for (const NodeId id : parts_of(*graph_, equations_)) {
      const Node node = (*graph_)[id];
      if (node.operation != Operation::backlash && node.operation != Operation::stop) continue;
      Contact contact;
      contact.corner = id;
      contact.penetration = graph_->symbol(fmt::format("penetration[{}]", contacts_.list.size()));
      contact.deflection = node.arguments[0];
      contact.backlash = node.arguments[1];
      contact.is_one_sided = node.operation == Operation::stop;
      contacts_.list.push_back(contact);
    }
    if (contacts_.list.empty() && hidden.empty()) return contacts_;
    name_them(names);
    find_directions();
    contacts_.list.insert(contacts_.list.end(), hidden.begin(), hidden.end());
    for (Contact& contact : contacts_.list) check_direction(&contact.direction);
    find_changes_along();
    return std::move(contacts_);
  }

 private:
  // By the constant that holds them; those of one constant are numbered, as are those of none.
  void name_them(const std::map<NodeId, std::string>& names) {
    if (contacts_.list.size() == 1) return;
    std::map<std::string, int> count, number;
    const auto holder = [&](const Contact& contact) {
      const auto found = names.find(contact.corner);
      return found == names.end() ? std::string() : found->second;
    };
    for (const Contact& contact : contacts_.list) ++count[holder(contact)];
    for (Contact& contact : contacts_.list) {
      const std::string name = holder(contact);
      contact.name = name.empty() ? "contact" : name;
      if (name.empty() || count[name] > 1) contact.name += fmt::format("{}", ++number[name]);
    }
  }

  void find_directions() {
    std::map<NodeId, NodeId> to_symbols, back;
    for (const Contact& contact : contacts_.list) {
      to_symbols[contact.corner] = contact.penetration;
      back[contact.penetration] = contact.corner;
    }
    Rewriter with_penetrations(graph_, to_symbols);
    for (const NodeId row : equations_) contacts_.equations.push_back(with_penetrations(row));
    for (Contact& contact : contacts_.list) {
      back[contact.penetration] = graph_->number(0.0);
      Rewriter at_limit(graph_, back);
      for (const NodeId row : contacts_.equations) {
        contact.direction.push_back(at_limit(derivative(graph_, row, contact.penetration)));
      }
      back[contact.penetration] = contact.corner;
    }
  }

  void check_direction(std::vector<NodeId>* direction) {
    if (!stay_finite(*graph_, *direction))
      direction->assign(equations_.size(), graph_->number(0.0));
    contacts_.direction_varies |= std::ranges::any_of(parts_of(*graph_, *direction),
                                                      [&](NodeId part) { return is_state(part); });
  }

  bool is_state(NodeId id) const {
    return std::ranges::find(formula_->states, id) != formula_->states.end();
  }

  void find_changes_along() {
    for (std::size_t j = 0; j < equations_.size(); ++j) {
      contacts_.along.push_back(graph_->symbol(fmt::format("direction[{}]", j)));
    }
    for (const NodeId row : equations_) contacts_.carried.push_back(change(row));
    for (const Contact& contact : contacts_.list) {
      contacts_.deflection_along.push_back(change(contact.deflection));
      contacts_.backlash_along.push_back(change(contact.backlash));
      for (const NodeId id : {contacts_.deflection_along.back(), contacts_.backlash_along.back()}) {
        contacts_.has_feedback |= !graph_->is_number(id, 0.0);
      }
    }
  }

  // Along any of the directions.
  NodeId change(NodeId of) {
    NodeId all = graph_->number(0.0);
    for (std::size_t j = 0; j < contacts_.along.size(); ++j) {
      const bool is_none = std::ranges::all_of(contacts_.list, [&](const Contact& contact) {
        return graph_->is_number(contact.direction[j], 0.0);
      });
      if (is_none) continue;
      const NodeId slope = derivative(graph_, of, formula_->states[j]);
      const NodeId part = graph_->make(Operation::multiply, {slope, contacts_.along[j]});
      all = graph_->make(Operation::add, {all, part});
    }
    return all;
  }

  Formula* formula_;
  ExpressionGraph* graph_;
  const std::vector<NodeId>& equations_;
  Contacts contacts_;
};

}  // namespace

bool stay_finite(const ExpressionGraph& graph, const std::vector<NodeId>& values) {
  return std::ranges::all_of(parts_of(graph, values), [&](NodeId id) {
    const Node& node = graph[id];
    if (node.operation == Operation::number) return std::isfinite(node.number);
    if (node.operation == Operation::power) return !graph.is_number(node.arguments[0], 0.0);
    if (node.operation == Operation::divide) return !graph.is_number(node.arguments[1], 0.0);
    return true;
  });
}

Contacts find_contacts(Formula* formula, const std::vector<NodeId>& equations,
                       const std::map<NodeId, std::string>& names,
                       const std::vector<Contact>& hidden) {
  return ContactFinder(formula, equations).run(names, hidden);
}

}  // namespace gearsweep
