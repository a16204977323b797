// The arrangement of equations for the inner loop: what no state changes is worked out once for a
// point, or tabulated over the phase, and joined with the states in the order that costs least.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <vector>

#include "equations/detail/dependence.hpp"
#include "equations/detail/formula.hpp"
#include "equations/detail/lowering.hpp"

namespace gearsweep {

class InnerLoop {
 public:
  // Both must outlive it. It adds the fields of a point and the coefficients that it needs.
  InnerLoop(Formula* formula, Lowered* lowered);

  // What is known of the equations, before any is arranged.
  void know_velocities() { dependences_.know_velocities(); }
  void know_sides(const std::vector<NodeId>& sides) { dependences_.know_sides(sides); }
  void know_phase(bool has_phase) { has_phase_ = has_phase; }
  // How often each node is used, with what was counted before: what is used elsewhere, too, stays
  // whole.
  void count_uses(const std::vector<NodeId>& roots);
  const Dependence& dependence_of(NodeId id) { return dependences_.of(id); }

  // The node in terms of what the inner loop has.
  NodeId arranged(NodeId id);
  // The same of a node that was arranged before.
  std::optional<NodeId> known(NodeId id) const;
  // The coefficient that has a value of the phase and of parameters.
  NodeId coef(NodeId id);

 private:
  // A part of a sum, or of a product.
  struct Part {
    NodeId id;
    bool is_inverse;  // subtracted, or divided by
    // What waits longest for the states is joined last: what no state changes, what positions alone
    // do, the others; the longer expressions after the shorter ones.
    std::array<std::size_t, 3> wait = {};
  };

  NodeId make(Operation operation, NodeId a, NodeId b) { return graph_->make(operation, {a, b}); }
  NodeId make_arranged(NodeId id);
  NodeId chosen(const Node& node);
  NodeId point_field(NodeId id);
  void take_apart(NodeId id, bool is_product, bool is_inverse, bool is_root,
                  std::vector<Part>* parts, bool* is_negative);
  NodeId joined(NodeId left, const Part& part, bool is_product);
  NodeId join(NodeId id, bool is_product, bool* is_negative);
  NodeId sum(NodeId id);
  bool is_of_point(NodeId id);
  std::vector<Part> factors_of(NodeId id, bool is_root, bool* is_negative);
  NodeId distributed(NodeId id);
  NodeId product(NodeId id);

  Formula* formula_;
  ExpressionGraph* graph_;
  Lowered* lowered_;
  std::map<NodeId, std::size_t> uses_;
  Dependences dependences_;
  std::map<NodeId, NodeId> arranged_;
  bool has_phase_ = false;
};

}  // namespace gearsweep
