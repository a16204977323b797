// What a node is made of, and the same made anew.
#include <algorithm>

#include "expression/expression.hpp"

namespace gearsweep {
namespace {

// The parts, where there are few; nothing where there are more.
std::vector<NodeId> few_parts_of(const ExpressionGraph& graph, std::vector<NodeId> open) {
  constexpr std::size_t kFew = 48;
  std::vector<NodeId> parts;
  while (!open.empty()) {
    const NodeId id = open.back();
    open.pop_back();
    if (std::ranges::find(parts, id) != parts.end()) continue;
    if (parts.size() == kFew) return {};
    parts.push_back(id);
    const std::vector<NodeId>& arguments = graph[id].arguments;
    open.insert(open.end(), arguments.begin(), arguments.end());
  }
  std::ranges::sort(parts);
  return parts;
}

}  // namespace

Rewriter::Rewriter(ExpressionGraph* graph, std::map<NodeId, NodeId> replaced)
    : graph_(graph), known_(replaced.begin(), replaced.end()) {}

NodeId Rewriter::operator()(NodeId id) {
  // Those that are not known yet, arguments first.
  std::vector<NodeId> parts, open = {id};
  while (!open.empty()) {
    const NodeId part = open.back();
    open.pop_back();
    if (!known_.emplace(part, part).second) continue;
    parts.push_back(part);
    const std::vector<NodeId>& arguments = (*graph_)[part].arguments;
    open.insert(open.end(), arguments.begin(), arguments.end());
  }
  std::ranges::sort(parts);
  for (const NodeId part : parts) {
    std::vector<NodeId> arguments = (*graph_)[part].arguments;
    if (arguments.empty()) continue;
    for (NodeId& argument : arguments) argument = known_.at(argument);
    known_[part] = graph_->with_arguments(part, arguments);
  }
  return known_.at(id);
}

std::vector<NodeId> parts_of(const ExpressionGraph& graph, const std::vector<NodeId>& roots) {
  if (std::vector<NodeId> few = few_parts_of(graph, roots); !few.empty()) return few;
  // Arguments have smaller ids.
  std::size_t end = 0;
  for (const NodeId root : roots) end = std::max<std::size_t>(end, root + 1);
  std::vector<bool> is_part(end);
  for (const NodeId root : roots) is_part[root] = true;
  std::size_t count = 0;
  for (std::size_t id = end; id-- > 0;) {
    if (!is_part[id]) continue;
    ++count;
    for (const NodeId argument : graph[static_cast<NodeId>(id)].arguments) is_part[argument] = true;
  }
  std::vector<NodeId> parts;
  parts.reserve(count);
  for (std::size_t id = 0; id < end; ++id) {
    if (is_part[id]) parts.push_back(static_cast<NodeId>(id));
  }
  return parts;
}

}  // namespace gearsweep
