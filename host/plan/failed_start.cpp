#include "plan/failed_start.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <map>
#include <vector>

#include "equations/field_graph.hpp"
#include "expression/print.hpp"

namespace gearsweep {
namespace {

// All parts of the equations, at phase 0.
class Values {
 public:
  Values(const Model& model, const ModelSetting& setting, const std::vector<double>& x)
      : graph_(model.field->graph) {
    const FieldGraph& field = *model.field;
    for (std::size_t i = 0; i < x.size(); ++i) values_[field.states[i]] = x[i];
    for (std::size_t i = 0; i < field.parameters.size(); ++i) {
      values_[field.parameters[i]] = setting.parameters[i];
    }
    std::size_t symbol = 0;
    const std::size_t open = field.choices.empty() ? 0 : model.options.size();
    for (std::size_t option = 0; option < open; ++option) {
      for (std::size_t choice = 0; choice < model.options[option].choices.size(); ++choice) {
        const bool is_made = setting.options[option] == static_cast<int>(choice);
        values_[field.choices[symbol++]] = is_made ? 1.0 : 0.0;
      }
    }
    for (const NodeId id : parts_of(graph_, field.rates)) values_.try_emplace(id, value_of(id));
  }

  double of(NodeId id) const { return values_.at(id); }

  // The innermost part that is not finite of one that is not.
  NodeId culprit(NodeId id) const {
    for (std::size_t i = 0; i < graph_[id].arguments.size(); ++i) {
      const NodeId argument = graph_[id].arguments[i];
      if (graph_[id].operation == Operation::select && i != chosen(id)) continue;
      if (!std::isfinite(of(argument))) return culprit(argument);
    }
    return id;
  }

 private:
  // Which of its three arguments a choice takes.
  std::size_t chosen(NodeId id) const { return of(graph_[id].arguments[0]) != 0.0 ? 1 : 2; }

  // Symbols other than those that are known stand for the phase.
  double value_of(NodeId id) const {
    const Node& node = graph_[id];
    if (node.operation == Operation::number) return node.number;
    if (node.operation == Operation::symbol) return 0.0;
    const auto argument = [&](std::size_t i) {
      return i < node.arguments.size() ? of(node.arguments[i]) : 0.0;
    };
    if (node.operation == Operation::table) return node.table->at(argument(0), argument(1));
    return apply(node.operation, argument(0), argument(1), argument(2));
  }

  const ExpressionGraph& graph_;
  std::map<NodeId, double> values_;
};

std::string described(const ExpressionGraph& graph, const Values& values, NodeId id) {
  const std::string text = to_short_text(graph, id);
  if (graph[id].operation != Operation::divide) return fmt::format("{} is {}", text, values.of(id));
  return fmt::format("{} is {:g}/{:g}", text, values.of(graph[id].arguments[0]),
                     values.of(graph[id].arguments[1]));
}

}  // namespace

std::string failure_at_start(const Plan& plan, std::size_t point) {
  const Model& model = *plan.study().model;
  if (model.whole != nullptr) return "";
  const std::vector<double> x = plan.own_initial_state(point);
  const Values values(model, plan.setting_of(point), x);
  for (std::size_t i = 0; i < x.size(); ++i) {
    const NodeId rate = model.field->rates[i];
    if (std::isfinite(values.of(rate))) continue;
    std::vector<std::string> states;
    for (std::size_t j = 0; j < x.size(); ++j) {
      states.push_back(fmt::format("{} = {:g}", model.states[j].name, x[j]));
    }
    return fmt::format("at its start, {}, {} in the equation of '{}'", fmt::join(states, ", "),
                       described(model.field->graph, values, values.culprit(rate)),
                       model.states[i].name);
  }
  return "";
}

}  // namespace gearsweep
