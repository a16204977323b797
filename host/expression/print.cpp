#include "expression/print.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace gearsweep {
namespace {

// How tightly an operation binds, as in the grammar; `right`: what its right argument must have.
struct Binding {
  int own, left, right;
  const char* text;
};

constexpr int kSigned = 7, kPrimary = 9;
constexpr std::size_t kReadAtAGlance = 100;  // parts of a text that is read at a glance

Binding binding_of(Operation operation) {
  switch (operation) {
    case Operation::disjunction:
      return {1, 1, 2, " or "};
    case Operation::conjunction:
      return {2, 2, 3, " and "};
    case Operation::negation:
      return {3, 3, 3, "not "};
    case Operation::less:
      return {4, 5, 5, " < "};
    case Operation::less_or_equal:
      return {4, 5, 5, " <= "};
    case Operation::equal:
      return {4, 5, 5, " == "};
    case Operation::add:
      return {5, 5, 6, " + "};
    case Operation::subtract:
      return {5, 5, 6, " - "};
    case Operation::multiply:
      return {6, 6, kSigned, "*"};
    case Operation::divide:
      return {6, 6, kSigned, "/"};
    case Operation::negate:
      return {kSigned, kSigned, kSigned, "-"};
    case Operation::power:
      return {8, kPrimary, kSigned, "^"};
    default:
      return {kPrimary, 0, 0, ""};
  }
}

// A negative number is written with a sign.
int binding_of(const Node& node) {
  if (node.operation == Operation::number) return std::signbit(node.number) ? kSigned : kPrimary;
  return binding_of(node.operation).own;
}

// 0 < option.choice stands for what an expression calls by the name alone.
bool is_choice(const ExpressionGraph& graph, const Node& node) {
  return node.operation == Operation::less && graph.is_number(node.arguments[0], 0.0) &&
         graph[node.arguments[1]].symbol.find('.') != std::string::npos;
}

class Printer {
 public:
  Printer(const ExpressionGraph& graph, const NodeNames& names) : graph_(graph), names_(names) {}

  std::string text_of(NodeId id, int least) const {
    const auto named = names_.find(id);
    if (named != names_.end()) return named->second;
    const Node& node = graph_[id];
    if (is_choice(graph_, node)) return graph_[node.arguments[1]].symbol;
    if (binding_of(node) < least) return fmt::format("({})", text_of(id, 0));
    if (node.operation == Operation::number) return fmt::format("{}", node.number);
    if (node.operation == Operation::symbol) return node.symbol;
    const Binding binding = binding_of(node.operation);
    if (binding.own < kPrimary) {
      const std::string last = text_of(node.arguments.back(), binding.right);
      if (node.arguments.size() == 1) return binding.text + last;
      return text_of(node.arguments[0], binding.left) + binding.text + last;
    }
    if (node.operation == Operation::table) return text_of_table(node);
    std::vector<std::string> arguments;
    for (const NodeId argument : node.arguments) arguments.push_back(text_of(argument, 0));
    const auto info = std::ranges::find(functions(), node.operation, &FunctionInfo::operation);
    return fmt::format("{}({})", info->name, fmt::join(arguments, ", "));
  }

  // A part counts as often as the text would have it.
  bool is_short(NodeId id) const {
    std::vector<NodeId> open = {id};
    std::size_t size = 0;
    while (!open.empty()) {
      const NodeId part = open.back();
      open.pop_back();
      if (++size > kReadAtAGlance) return false;
      if (names_.contains(part)) continue;
      const std::vector<NodeId>& arguments = graph_[part].arguments;
      open.insert(open.end(), arguments.begin(), arguments.end());
    }
    return true;
  }

 private:
  std::string text_of_table(const Node& node) const {
    const PeriodicTable& table = *node.table;
    const char quote = table.name().find('"') == std::string::npos ? '"' : '\'';
    const bool is_linear = table.interpolation() == Interpolation::linear;
    return fmt::format("table({}{}{}, {}{})", quote, table.name(), quote,
                       text_of(node.arguments[0], 0),
                       is_linear ? "" : fmt::format(", {}", name_of(table.interpolation())));
  }

  const ExpressionGraph& graph_;
  const NodeNames& names_;
};

}  // namespace

std::string to_text(const ExpressionGraph& graph, NodeId id) {
  const NodeNames none;
  return Printer(graph, none).text_of(id, 0);
}

std::string to_short_text(const ExpressionGraph& graph, NodeId id, const NodeNames& names) {
  const Printer printer(graph, names);
  if (!printer.is_short(id)) {
    return fmt::format("an expression of {} parts", parts_of(graph, {id}).size());
  }
  std::string text = printer.text_of(id, 0);
  std::ranges::replace_if(
      text, [](char c) { return c < ' ' || c > '~' || c == '\\' || c == '?'; }, '_');
  return text;
}

}  // namespace gearsweep
