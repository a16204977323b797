#include "equations/expression_text.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "expression/parse.hpp"
#include "expression/tape.hpp"
#include "model/error.hpp"

namespace gearsweep {

void fail_in(const ExpressionText& text, std::size_t position, const std::string& message) {
  const std::string column = text.line == 0 ? "" : fmt::format(":{}", text.column + position);
  throw InputError(
      fmt::format("{}{}: {}\n{}", text.place(), column, message, with_caret(text.text, position)));
}

double number_of(const ExpressionText& text) {
  const ExpressionNames no_names = {
      .find = [](const std::string&) -> std::optional<NodeId> { return std::nullopt; },
      .known = [] { return std::vector<std::string>(); }};
  ExpressionGraph graph;
  try {
    const NodeId id = parse_expression(text.text, no_names, &graph);
    const double value = Tape(graph, {}, {id}).run({});
    if (!std::isfinite(value)) fail_in(text, 0, fmt::format("this comes to {}", value));
    return value;
  } catch (const ExpressionError& error) {
    fail_in(text, error.position, error.what());
  }
}

}  // namespace gearsweep
