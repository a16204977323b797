// The text of an expression to a node.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "expression/expression.hpp"

namespace gearsweep {

// The text is wrong; `position` is the byte where.
struct ExpressionError : std::runtime_error {
  ExpressionError(std::size_t at, const std::string& message)
      : std::runtime_error(message), position(at) {}
  std::size_t position;
};

// table("file.csv", argument, interpolation), as a text has it.
struct TableCall {
  std::string file;
  NodeId argument = 0;
  Interpolation interpolation = Interpolation::linear;
  std::size_t file_at = 0, argument_at = 0;  // bytes of the text where these begin
};

// The names that a text may use, beside functions and pi.
struct ExpressionNames {
  std::function<std::optional<NodeId>(const std::string& name)> find;
  std::function<std::vector<std::string>()> known;  // for the message about another name
  // The same one for each call that asks for the same. Throws ExpressionError. Empty where a text
  // may read no tables.
  std::function<std::shared_ptr<const PeriodicTable>(const TableCall&)> table = {};
};

// The node as written; clamp, step and pi are written out. A condition only where is_condition.
// Throws ExpressionError, also for what is nested too deeply or too large.
NodeId parse_expression(std::string_view text, const ExpressionNames& names,
                        ExpressionGraph* graph);

// The line of a text with a caret under a position, in two lines; a long line is cut around it.
std::string with_caret(std::string_view text, std::size_t position);

}  // namespace gearsweep
