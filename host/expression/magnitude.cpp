#include "expression/magnitude.hpp"

#include <map>

namespace gearsweep {
namespace {

class Magnitude {
 public:
  explicit Magnitude(ExpressionGraph* graph) : graph_(graph) {}

  NodeId operator()(NodeId id) {
    const auto known = known_.find(id);
    if (known != known_.end()) return known->second;
    const NodeId made = make(id);
    known_.emplace(id, made);
    return made;
  }

 private:
  NodeId make(NodeId id) {
    const Node node = (*graph_)[id];  // a copy: the graph grows
    const auto of = [&](std::size_t argument) { return (*this)(node.arguments[argument]); };
    switch (node.operation) {
      case Operation::negate:
      case Operation::absolute:
        return of(0);
      case Operation::add:
      case Operation::subtract:
        return graph_->make(Operation::add, {of(0), of(1)});
      case Operation::multiply:
        return graph_->make(Operation::multiply, {of(0), of(1)});
      case Operation::divide:
        return graph_->make(Operation::divide, {of(0), plain(node.arguments[1])});
      case Operation::min:
      case Operation::max:
      case Operation::backlash:
      case Operation::stop:
        return graph_->make(Operation::max, {of(0), of(1)});
      case Operation::select:
        return graph_->make(Operation::select, {node.arguments[0], of(1), of(2)});
      default:
        return plain(id);
    }
  }

  NodeId plain(NodeId id) { return graph_->make(Operation::absolute, {id}); }

  ExpressionGraph* graph_;
  std::map<NodeId, NodeId> known_;
};

}  // namespace

NodeId magnitude_of(ExpressionGraph* graph, NodeId id) { return Magnitude(graph)(id); }

}  // namespace gearsweep
