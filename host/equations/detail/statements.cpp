#include "equations/detail/statements.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace gearsweep {
namespace {

constexpr std::size_t kMaxLine = 400;  // characters of an expression that has no name of its own

class Statements {
 public:
  Statements(const ExpressionGraph& graph, const std::map<NodeId, std::string>& names)
      : graph_(graph), names_(names) {}

  std::string run(const std::vector<Assignment>& assignments) {
    std::vector<NodeId> roots;
    for (const Assignment& assignment : assignments) roots.push_back(assignment.second);
    const std::vector<NodeId> parts = parts_of(graph_, roots);
    std::map<NodeId, std::size_t> uses;
    for (const NodeId id : parts) {
      for (const NodeId argument : graph_[id].arguments) ++uses[argument];
    }
    for (const NodeId id : roots) ++uses[id];
    for (const NodeId id : parts) {
      const Node& node = graph_[id];
      std::string text = text_of(id);
      const bool is_shared = uses[id] > 1 || text.size() > kMaxLine;
      if (node.arguments.empty() || !is_shared) {
        texts_[id] = std::move(text);
        continue;
      }
      const std::string name = fmt::format("t{}", count_++);
      out_ += fmt::format("  const {} {} = {};\n", is_condition(node.operation) ? "mask" : "real",
                          name, text);
      texts_[id] = name;
    }
    for (const auto& [place, id] : assignments) {
      out_ += fmt::format("  {} = {};\n", place, plain(texts_.at(id)));
    }
    return out_;
  }

 private:
  // Without the parentheses around all of it.
  static std::string plain(const std::string& text) {
    if (!text.starts_with('(') || !text.ends_with(')')) return text;
    int depth = 0;
    for (std::size_t i = 0; i + 1 < text.size(); ++i) {
      depth += text[i] == '(' ? 1 : text[i] == ')' ? -1 : 0;
      if (depth == 0) return text;
    }
    return text.substr(1, text.size() - 2);
  }

  std::string text_of(NodeId id) const {
    const Node& node = graph_[id];
    const auto argument = [&](std::size_t i) { return texts_.at(node.arguments[i]); };
    const auto vector = [&](std::size_t i) { return as_vector(node.arguments[i]); };
    const auto infix = [&](const char* sign) {
      return fmt::format("({} {} {})", argument(0), sign, argument(1));
    };
    switch (node.operation) {
      case Operation::number:
        return fmt::format("(scalar)({})", number_of(node.number));
      case Operation::symbol:
        return names_.at(id);
      case Operation::negate:
        return fmt::format("(-{})", argument(0));
      case Operation::add:
        return infix("+");
      case Operation::subtract:
        return infix("-");
      case Operation::multiply:
        return infix("*");
      case Operation::divide:
        return infix("/");
      case Operation::less:
        return fmt::format("({} < {})", vector(0), vector(1));
      case Operation::less_or_equal:
        return fmt::format("({} <= {})", vector(0), vector(1));
      case Operation::equal:
        return fmt::format("({} == {})", vector(0), vector(1));
      case Operation::conjunction:
        return infix("&");
      case Operation::disjunction:
        return infix("|");
      case Operation::negation:
        return fmt::format("(!{})", argument(0));
      case Operation::select:
        return fmt::format("lane_select({}, {}, {})", argument(0), vector(1), vector(2));
      default:
        return function_text(node);
    }
  }

  // A function of the device.
  std::string function_text(const Node& node) const {
    const auto vector = [&](std::size_t i) { return as_vector(node.arguments[i]); };
    switch (node.operation) {
      case Operation::min:
        return fmt::format("lane_min({}, {})", vector(0), vector(1));
      case Operation::max:
        return fmt::format("lane_max({}, {})", vector(0), vector(1));
      case Operation::absolute:
        return fmt::format("lane_abs({})", vector(0));
      case Operation::square_root:
        return fmt::format("lane_sqrt({})", vector(0));
      case Operation::square_root_above_one:
        return fmt::format("lane_sqrt1pm1({})", vector(0));
      case Operation::sign:
        return fmt::format(
            "lane_select({0} < (real)(0), (real)(-1), lane_select((real)(0) < {0}, (real)(1), "
            "(real)(0)))",
            vector(0));
      case Operation::backlash:
        return fmt::format("(lane_max({0} - {1}, (real)(0)) + lane_min({0} + {1}, (real)(0)))",
                           vector(0), vector(1));
      case Operation::stop:
        return fmt::format("lane_max({} - {}, (real)(0))", vector(0), vector(1));
      case Operation::power:
        return fmt::format("lane_pow({}, {})", vector(0), vector(1));
      case Operation::table:
        throw std::logic_error("a table is no function of the device");
      default:
        break;
    }
    const auto info = std::ranges::find(functions(), node.operation, &FunctionInfo::operation);
    return node.arguments.size() == 1 ? fmt::format("{}({})", info->name, vector(0))
                                      : fmt::format("{}({}, {})", info->name, vector(0), vector(1));
  }

  // Numbers and phase coefficients are no vectors, which what is not arithmetic needs.
  std::string as_vector(NodeId id) const { return fmt::format("(real)({})", plain(texts_.at(id))); }

  static std::string number_of(double value) {
    std::string text = fmt::format("{}", value);
    if (text.find_first_of(".en") == std::string::npos) text += ".0";
    return text;
  }

  const ExpressionGraph& graph_;
  const std::map<NodeId, std::string>& names_;
  std::map<NodeId, std::string> texts_;
  std::size_t count_ = 0;
  std::string out_;
};

}  // namespace

std::string statements_of(const ExpressionGraph& graph, const std::vector<Assignment>& assignments,
                          const std::map<NodeId, std::string>& names) {
  return Statements(graph, names).run(assignments);
}

}  // namespace gearsweep
