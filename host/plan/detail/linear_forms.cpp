#include "plan/detail/linear_forms.hpp"

#include <algorithm>
#include <set>
#include <utility>

namespace gearsweep {
namespace {

class FormFinder {
 public:
  FormFinder(ExpressionGraph* graph, const std::vector<NodeId>& symbols) : graph_(graph) {
    for (const NodeId symbol : symbols) known_[symbol] = LinearForm{{symbol, graph->number(1.0)}};
  }

  // Its arguments are known.
  void find(NodeId id) {
    if (!known_.contains(id)) known_.emplace(id, form_of((*graph_)[id]));
  }

  const std::optional<LinearForm>& form(NodeId id) const { return known_.at(id); }

 private:
  using Form = std::optional<LinearForm>;

  Form form_of(Node node) {  // a copy: the graph grows
    std::vector<LinearForm> forms;
    for (const NodeId argument : node.arguments) {
      if (!form(argument)) return std::nullopt;
      forms.push_back(*form(argument));
    }
    if (std::ranges::all_of(forms, &LinearForm::empty)) return LinearForm();
    switch (node.operation) {
      case Operation::negate:
        return each(forms[0], [&](NodeId a) { return make(Operation::negate, {a}); });
      case Operation::add:
      case Operation::subtract:
        return joined(forms[0], forms[1], [&](NodeId a, NodeId b) {
          return make(node.operation, {a, b});
        });
      case Operation::multiply:
        if (!forms[0].empty() && !forms[1].empty()) return std::nullopt;
        return each(forms[0].empty() ? forms[1] : forms[0], [&](NodeId a) {
          return make(Operation::multiply, {a, node.arguments[forms[0].empty() ? 0 : 1]});
        });
      case Operation::divide:
        if (!forms[1].empty()) return std::nullopt;
        return each(forms[0], [&](NodeId a) {
          return make(Operation::divide, {a, node.arguments[1]});
        });
      case Operation::select:
        if (!forms[0].empty()) return std::nullopt;
        return joined(forms[1], forms[2], [&](NodeId a, NodeId b) {
          return make(Operation::select, {node.arguments[0], a, b});
        });
      default:
        return std::nullopt;
    }
  }

  NodeId make(Operation operation, const std::vector<NodeId>& arguments) {
    return graph_->make(operation, arguments);
  }

  template <class Change>
  LinearForm each(const LinearForm& form, const Change& change) {
    LinearForm out;
    for (const auto& [symbol, coefficient] : form) set(symbol, change(coefficient), &out);
    return out;
  }

  template <class Join>
  LinearForm joined(const LinearForm& a, const LinearForm& b, const Join& join) {
    const NodeId zero = graph_->number(0.0);
    const auto of = [&](const LinearForm& form, NodeId symbol) {
      const auto found = form.find(symbol);
      return found == form.end() ? zero : found->second;
    };
    LinearForm out;
    for (const LinearForm* form : {&a, &b}) {
      for (const auto& [symbol, coefficient] : *form) {
        set(symbol, join(of(a, symbol), of(b, symbol)), &out);
      }
    }
    return out;
  }

  void set(NodeId symbol, NodeId coefficient, LinearForm* form) {
    if (!is_zero_sum(*graph_, coefficient)) form->insert_or_assign(symbol, coefficient);
  }

  ExpressionGraph* graph_;
  std::map<NodeId, Form> known_;
};

}  // namespace

std::vector<std::optional<LinearForm>> linear_forms(ExpressionGraph* graph,
                                                    const std::vector<NodeId>& nodes,
                                                    const std::vector<NodeId>& symbols) {
  FormFinder finder(graph, symbols);
  for (const NodeId id : parts_of(*graph, nodes)) finder.find(id);
  std::vector<std::optional<LinearForm>> forms;
  for (const NodeId id : nodes) forms.push_back(finder.form(id));
  return forms;
}

bool is_zero_sum(const ExpressionGraph& graph, NodeId id) {
  constexpr std::size_t kManyTerms = 1000;
  // Numbers cancel one by one: a sum of them would lose the smaller ones.
  std::map<NodeId, std::multiset<double>> terms;
  std::vector<std::pair<NodeId, double>> open = {{id, 1.0}};
  const NodeId none = id;  // stands for the numbers themselves
  for (std::size_t seen = 0; !open.empty(); ++seen) {
    if (seen > kManyTerms) return false;
    const auto [part, factor] = open.back();
    open.pop_back();
    const Node& node = graph[part];
    const auto add = [&](NodeId term, double number) {
      std::multiset<double>& numbers = terms[term];
      const auto opposite = numbers.find(-number);
      if (opposite == numbers.end()) {
        numbers.insert(number);
      } else {
        numbers.erase(opposite);
      }
    };
    if (node.operation == Operation::number) {
      if (node.number != 0.0) add(none, factor * node.number);
    } else if (node.operation == Operation::negate) {
      open.emplace_back(node.arguments[0], -factor);
    } else if (node.operation == Operation::add || node.operation == Operation::subtract) {
      const double sign = node.operation == Operation::add ? 1.0 : -1.0;
      open.emplace_back(node.arguments[0], factor);
      open.emplace_back(node.arguments[1], sign * factor);
    } else if (node.operation == Operation::multiply && graph.is_number(node.arguments[0])) {
      open.emplace_back(node.arguments[1], factor * graph[node.arguments[0]].number);
    } else {
      add(part, factor);
    }
  }
  return std::ranges::all_of(terms, [](const auto& term) { return term.second.empty(); });
}

}  // namespace gearsweep
