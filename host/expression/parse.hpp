// The text of an expression to a node.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "expression/expression.hpp"
#include "expression/expression_error.hpp"

namespace gearsweep {

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
  // Functions of the text's own: how many arguments one takes, nothing where there is none of the
  // name; what a call comes to; their names.
  std::function<std::optional<std::size_t>(const std::string& name)> arguments_of = {};
  std::function<NodeId(const std::string& name, const std::vector<NodeId>& arguments)> call = {};
  std::function<std::vector<std::string>()> known_functions = {};
  std::size_t max_depth = 256;  // of what is nested; less where texts are read within others
  // The same one for each call that asks for the same. Throws ExpressionError. Empty where a text
  // may read no tables.
  std::function<std::shared_ptr<const PeriodicTable>(const TableCall&)> table = {};
  // Curves, and the value of one at an angle in radians. position: byte of the text where the
  // argument begins.
  std::function<bool(const std::string& name)> is_curve = {};
  std::function<NodeId(const std::string& name, NodeId argument, std::size_t position)> curve = {};
};

// The node as written; clamp, step, sum, indices and pi are written out. a[2] is the name a_2, and
// a[1] is a_1 or a. A condition only where is_condition. Throws ExpressionError, also for what is
// nested too deeply or too large.
NodeId parse_expression(std::string_view text, const ExpressionNames& names,
                        ExpressionGraph* graph);

}  // namespace gearsweep
