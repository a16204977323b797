// Texts of a model to nodes of its formula: what their names mean.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "equations/definition.hpp"
#include "equations/detail/formula.hpp"
#include "equations/detail/tables.hpp"

namespace gearsweep {

// "option.choice", of all options one after the other.
std::vector<std::string> choice_names(const std::vector<OptionInfo>& options);

// All throw InputError, with the place of what is wrong.
class TextReader {
 public:
  // formula: has its symbols already, and gains nodes. Both outlive this.
  TextReader(const ModelDefinition& definition, Formula* formula);

  // Parameters that follow from others, functions and constants. Those that nothing uses, too: a
  // mistake in one is a mistake.
  void read_definitions();
  NodeId read(const ExpressionText& text);
  // what: it is, for messages.
  NodeId of_parameters(const ExpressionText& text, const std::string& what);
  // Its rate is needed, and how a table changes with the phase is not known.
  NodeId without_table(const ExpressionText& text);

  // By name, those that were read.
  const std::map<std::string, NodeId>& constants() const { return constants_; }
  // What no text has used. A parameter of a constant that nothing uses is used by nothing.
  std::vector<UnusedName> unused();

 private:
  using Arguments = std::map<std::string, NodeId>;  // of a function, by name
  // A parameter that is read as a constant is.
  struct Derived {
    std::size_t parameter;
    NamedExpression constant;
  };

  NodeId read_with(const ExpressionText& text, const Arguments& given);
  NodeId read_open(const std::string& name, const ExpressionText& text, const Arguments& given);
  void read_by_itself(const NamedFunction& function);
  NodeId require_parameters(NodeId id, const ExpressionText& text, const std::string& what) const;
  // One that is not measured is 0.
  NodeId curve_at(const std::string& name, NodeId argument, std::size_t position);
  NodeId as_condition(bool holds);
  std::optional<NodeId> find(const std::string& name);
  // Whether a condition on choices that are made, or on curves, holds: option.choice and
  // curve.given.
  std::optional<bool> known_condition(const std::string& name) const;
  NodeId value_of(const NamedExpression& constant);
  NodeId value_of(const NamedFunction& function, const std::vector<NodeId>& arguments);
  const NamedFunction* find_function(const std::string& name) const;
  std::vector<std::string> known_names() const;
  // The constant or function that is being read.
  std::string user() const;

  const ModelDefinition& definition_;
  Formula& formula_;
  Tables tables_;
  std::map<std::string, Derived> derived_;  // by their names in expressions
  std::map<std::string, NodeId> constants_;
  std::map<std::pair<std::string, std::vector<NodeId>>, NodeId> calls_;  // what each comes to
  std::vector<std::string> open_;  // constants and functions that are being read, outermost first
  // The names in each of these; with no name those in all else.
  std::map<std::string, std::set<std::string>> uses_;
};

}  // namespace gearsweep
