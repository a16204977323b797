#include "expression/tape.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <stdexcept>

namespace gearsweep {
namespace {

constexpr std::size_t kShort = 256;  // places that need no memory of their own

}  // namespace

Tape::Tape(const ExpressionGraph& graph, const std::vector<NodeId>& inputs,
           const std::vector<NodeId>& outputs)
    : inputs_(inputs.size()) {
  std::map<NodeId, std::size_t> places;
  for (std::size_t i = 0; i < inputs.size(); ++i) places.emplace(inputs[i], i);
  // What lies below an input is not needed.
  std::vector<NodeId> needed, open = outputs;
  while (!open.empty()) {
    const NodeId id = open.back();
    open.pop_back();
    if (places.contains(id) || std::ranges::find(needed, id) != needed.end()) continue;
    needed.push_back(id);
    for (const NodeId argument : graph[id].arguments) open.push_back(argument);
  }
  std::ranges::sort(needed);
  for (const NodeId id : needed) {
    if (!graph.is_number(id)) continue;
    places.emplace(id, inputs_ + numbers_.size());
    numbers_.push_back(graph[id].number);
  }
  for (const NodeId id : needed) {
    if (graph.is_number(id)) continue;
    const Node& node = graph[id];
    if (node.operation == Operation::symbol) {
      throw std::logic_error("nothing gives '" + node.symbol + "'");
    }
    const auto place = [&](std::size_t i) {
      return i < node.arguments.size() ? places.at(node.arguments[i]) : 0;
    };
    steps_.push_back({node.operation, place(0), place(1), place(2)});
    if (node.operation == Operation::table) {
      steps_.back().c = tables_.size();
      tables_.push_back(node.table);
    }
    places.emplace(id, inputs_ + numbers_.size() + steps_.size() - 1);
  }
  for (const NodeId id : outputs) outputs_.push_back(places.at(id));
}

void Tape::run(const double* inputs, double* outputs) const {
  const std::size_t size = inputs_ + numbers_.size() + steps_.size();
  std::array<double, kShort> near;
  std::vector<double> far(size > kShort ? size : 0);
  double* const values = size > kShort ? far.data() : near.data();
  std::copy_n(inputs, inputs_, values);
  double* next = std::ranges::copy(numbers_, values + inputs_).out;
  for (const Step& step : steps_) {
    *next++ = step.operation == Operation::table
                  ? tables_[step.c]->at(values[step.a], values[step.b])
                  : apply(step.operation, values[step.a], values[step.b], values[step.c]);
  }
  for (const std::size_t place : outputs_) *outputs++ = values[place];
}

double Tape::run(const std::vector<double>& inputs) const {
  double output = 0.0;
  run(inputs.data(), &output);
  return output;
}

std::vector<double> Tape::run_all(const std::vector<double>& inputs) const {
  std::vector<double> outputs(outputs_.size());
  run(inputs.data(), outputs.data());
  return outputs;
}

}  // namespace gearsweep
