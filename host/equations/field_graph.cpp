#include "equations/field_graph.hpp"

#include <algorithm>
#include <map>

namespace gearsweep {
namespace {

void choose(const Model& model, const std::vector<int>& options, FieldGraph* field) {
  if (field->choices.empty()) return;
  std::map<NodeId, NodeId> numbers;
  std::size_t symbol = 0;
  for (std::size_t option = 0; option < model.options.size(); ++option) {
    for (std::size_t choice = 0; choice < model.options[option].choices.size(); ++choice) {
      const bool is_made = options[option] == static_cast<int>(choice);
      numbers[field->choices[symbol++]] = field->graph.number(is_made ? 1.0 : 0.0);
    }
  }
  field->choices.clear();
  Rewriter chosen(&field->graph, std::move(numbers));
  for (NodeId& rate : field->rates) rate = chosen(rate);
  for (NodeId& signal : field->signals) signal = chosen(signal);
}

}  // namespace

FieldGraph field_of(const Model& model, const std::vector<int>& options) {
  FieldGraph field = *model.field;
  choose(model, options, &field);
  return field;
}

std::vector<std::size_t> symbols_in(const ExpressionGraph& graph, const std::vector<NodeId>& nodes,
                                    const std::vector<NodeId>& symbols) {
  const std::vector<NodeId> parts = parts_of(graph, nodes);  // sorted
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < symbols.size(); ++i) {
    if (std::ranges::binary_search(parts, symbols[i])) places.push_back(i);
  }
  return places;
}

}  // namespace gearsweep
