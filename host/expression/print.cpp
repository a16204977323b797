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

std::string text_of(const ExpressionGraph& graph, NodeId id, int least) {
  const Node& node = graph[id];
  if (is_choice(graph, node)) return graph[node.arguments[1]].symbol;
  if (binding_of(node) < least) return fmt::format("({})", text_of(graph, id, 0));
  if (node.operation == Operation::number) return fmt::format("{}", node.number);
  if (node.operation == Operation::symbol) return node.symbol;
  const Binding binding = binding_of(node.operation);
  if (binding.own < kPrimary) {
    const std::string last = text_of(graph, node.arguments.back(), binding.right);
    if (node.arguments.size() == 1) return binding.text + last;
    return text_of(graph, node.arguments[0], binding.left) + binding.text + last;
  }
  if (node.operation == Operation::table) {
    const PeriodicTable& table = *node.table;
    const char quote = table.name().find('"') == std::string::npos ? '"' : '\'';
    const bool is_linear = table.interpolation() == Interpolation::linear;
    return fmt::format("table({}{}{}, {}{})", quote, table.name(), quote,
                       text_of(graph, node.arguments[0], 0),
                       is_linear ? "" : fmt::format(", {}", name_of(table.interpolation())));
  }
  std::vector<std::string> arguments;
  for (const NodeId argument : node.arguments) arguments.push_back(text_of(graph, argument, 0));
  const auto info = std::ranges::find(functions(), node.operation, &FunctionInfo::operation);
  return fmt::format("{}({})", info->name, fmt::join(arguments, ", "));
}

}  // namespace

std::string to_text(const ExpressionGraph& graph, NodeId id) { return text_of(graph, id, 0); }

std::string to_short_text(const ExpressionGraph& graph, NodeId id) {
  // A part counts as often as the text would have it.
  std::vector<NodeId> open = {id};
  std::size_t size = 0;
  while (!open.empty()) {
    const std::vector<NodeId>& arguments = graph[open.back()].arguments;
    open.pop_back();
    open.insert(open.end(), arguments.begin(), arguments.end());
    if (++size > kReadAtAGlance) {
      return fmt::format("an expression of {} parts", parts_of(graph, {id}).size());
    }
  }
  std::string text = to_text(graph, id);
  std::ranges::replace_if(
      text, [](char c) { return c < ' ' || c > '~' || c == '\\' || c == '?'; }, '_');
  return text;
}

}  // namespace gearsweep
