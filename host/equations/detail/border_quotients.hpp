// Quotients by lhs - rhs of what vanishes where that does: at a border.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <utility>

#include "equations/detail/borders.hpp"

namespace gearsweep {

class Quotients {
 public:
  // Both must outlive the object, and the formula's graph gains the quotients.
  Quotients(Formula* formula, const Border& border);

  // The quotient of the difference of two nodes, exactly or to first order in lhs - rhs. Nothing
  // where the graph does not show one.
  std::optional<NodeId> of(NodeId a, NodeId b);

 private:
  // slope*lhs + offset.
  struct Line {
    double slope = 0.0, offset = 0.0;
  };

  std::optional<NodeId> look(NodeId a, NodeId b);
  std::optional<NodeId> of(NodeId id);
  std::optional<NodeId> look(NodeId id);
  // The line that numbers alone make of the left side.
  std::optional<Line> line_of(NodeId id);
  std::optional<Line> look_for_line(NodeId id);
  // c of what is c*(lhs - rhs) but for rounding, where rhs is a number.
  std::optional<double> factor_of_line(NodeId id);
  // To first order, by the derivative at the border; exact where that is the same everywhere.
  std::optional<NodeId> by_slope(NodeId id);
  NodeId make(Operation operation, NodeId a, NodeId b) { return graph_->make(operation, {a, b}); }

  ExpressionGraph* graph_;
  const std::set<NodeId> states_;
  const Border& border_;
  Rewriter at_border_;
  const NodeId one_way_, other_way_;
  std::map<NodeId, std::optional<NodeId>> known_;
  std::map<NodeId, std::optional<Line>> lines_;
  std::map<std::pair<NodeId, NodeId>, std::optional<NodeId>> known_pairs_;
};

}  // namespace gearsweep
