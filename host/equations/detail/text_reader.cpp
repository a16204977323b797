#include "equations/detail/text_reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "expression/parse.hpp"
#include "model/names.hpp"

namespace gearsweep {
namespace {

const char* const kModel = "";  // no name of a constant
// Texts are read within texts, each some levels deep: so many, and so much less deep each time.
constexpr std::size_t kMaxOpen = 15, kLessDepth = 16;
constexpr std::size_t kMaxCalls = 4000;  // of functions

}  // namespace

std::vector<std::string> choice_names(const std::vector<OptionInfo>& options) {
  std::vector<std::string> names;
  for (const OptionInfo& option : options) {
    for (const std::string& choice : option.choices) {
      names.push_back(fmt::format("{}.{}", option.name, choice));
    }
  }
  return names;
}

TextReader::TextReader(const ModelDefinition& definition, Formula* formula)
    : definition_(definition), formula_(*formula), tables_(definition.table_points) {
  for (std::size_t i = 0; i < definition.parameters.size(); ++i) {
    const auto given = definition.expressions.find(definition.parameters[i].name);
    if (given == definition.expressions.end()) continue;
    const std::string& symbol = definition.symbols[i].text;
    derived_.emplace(symbol, Derived{i, {symbol, given->second}});
  }
}

void TextReader::read_definitions() {
  for (const auto& [symbol, derived] : derived_) {
    const std::string what =
        fmt::format("the parameter '{}'", definition_.parameters[derived.parameter].name);
    const ExpressionText& text = derived.constant.expression;
    formula_.derived.emplace_back(derived.parameter,
                                  require_parameters(value_of(derived.constant), text, what));
  }
  for (const NamedFunction& function : definition_.functions) read_by_itself(function);
  for (const NamedExpression& constant : definition_.constants) value_of(constant);
}

NodeId TextReader::read(const ExpressionText& text) { return read_with(text, {}); }

NodeId TextReader::read_with(const ExpressionText& text, const Arguments& given) {
  ExpressionNames names = {
      .find =
          [&](const std::string& name) {
            const auto argument = given.find(name);
            return argument != given.end() ? argument->second : find(name);
          },
      .known =
          [&] {
            std::vector<std::string> known = known_names();
            for (const auto& [name, id] : given) known.push_back(name);
            return known;
          },
      .arguments_of = [this](const std::string& name) -> std::optional<std::size_t> {
        const NamedFunction* function = find_function(name);
        if (function == nullptr) return std::nullopt;
        return function->arguments.size();
      },
      .call =
          [this](const std::string& name, const std::vector<NodeId>& arguments) {
            uses_[user()].insert(name);
            return value_of(*find_function(name), arguments);
          },
      .known_functions =
          [this] {
            std::vector<std::string> known;
            for (const NamedFunction& one : definition_.functions) known.push_back(one.name);
            return known;
          },
      .table =
          [this](const TableCall& call) {
            if (derived_.contains(user())) {
              throw ExpressionError(call.file_at,
                                    "a parameter may use parameters alone, not a table");
            }
            return tables_.read(call, formula_);
          },
      .is_curve =
          [this](const std::string& name) {
            return std::ranges::find(definition_.curves, name) != definition_.curves.end();
          },
      .curve = [this](const std::string& name, NodeId argument,
                      std::size_t position) { return curve_at(name, argument, position); }};
  names.max_depth -= kLessDepth * open_.size();
  try {
    return parse_expression(text.text, names, &formula_.graph);
  } catch (const ExpressionError& error) {
    fail_in(text, error.position, error.what());
  }
}

NodeId TextReader::of_parameters(const ExpressionText& text, const std::string& what) {
  return require_parameters(read(text), text, what);
}

NodeId TextReader::require_parameters(NodeId id, const ExpressionText& text,
                                      const std::string& what) const {
  for (const NodeId part : parts_of(formula_.graph, {id})) {
    if (formula_.graph[part].operation == Operation::table) {
      fail_in(text, 0, fmt::format("{} may use parameters alone, not a table", what));
    }
    const bool is_state = std::ranges::find(formula_.states, part) != formula_.states.end();
    if (!is_state && part != formula_.phase && part != formula_.turn) continue;
    fail_in(
        text, 0,
        fmt::format("{} may use parameters alone, not '{}'", what, formula_.graph[part].symbol));
  }
  return id;
}

NodeId TextReader::without_table(const ExpressionText& text) {
  const NodeId id = read(text);
  for (const NodeId part : parts_of(formula_.graph, {id})) {
    if (formula_.graph[part].operation != Operation::table) continue;
    fail_in(text, 0, "a surface may read no table and no curve");
  }
  return id;
}

NodeId TextReader::curve_at(const std::string& name, NodeId argument, std::size_t position) {
  refuse_states({name, argument, Interpolation::linear, position, position}, formula_);
  const auto given = definition_.given_curves.find(name);
  if (given == definition_.given_curves.end()) return formula_.graph.number(0.0);
  return formula_.graph.table(given->second, argument, argument);
}

NodeId TextReader::as_condition(bool holds) {
  const NodeId number = formula_.graph.number(holds ? 1.0 : 0.0);
  return formula_.graph.as_written(Operation::less, {formula_.graph.number(0.0), number});
}

std::optional<NodeId> TextReader::find(const std::string& name) {
  uses_[user()].insert(name);
  if (name == "phase") return formula_.phase;
  if (name == "turn" && formula_.turn) return formula_.turn;
  if (const std::optional<bool> holds = known_condition(name)) return as_condition(*holds);
  const auto derived = derived_.find(name);
  if (derived != derived_.end()) return value_of(derived->second.constant);
  for (const std::vector<NodeId>* symbols : {&formula_.states, &formula_.parameters}) {
    for (const NodeId id : *symbols) {
      if (formula_.graph[id].symbol == name) return id;
    }
  }
  for (const NodeId id : formula_.choices) {
    if (formula_.graph[id].symbol != name) continue;
    return formula_.graph.as_written(Operation::less, {formula_.graph.number(0.0), id});
  }
  const auto constant = std::ranges::find(definition_.constants, name, &NamedExpression::name);
  if (constant == definition_.constants.end()) return std::nullopt;
  return value_of(*constant);
}

std::optional<bool> TextReader::known_condition(const std::string& name) const {
  for (const std::string& curve : definition_.curves) {
    if (name == curve + ".given") return definition_.given_curves.contains(curve);
  }
  for (std::size_t i = 0; i < definition_.choices.size(); ++i) {
    const OptionInfo& option = definition_.options[i];
    for (std::size_t j = 0; j < option.choices.size(); ++j) {
      if (name != fmt::format("{}.{}", option.name, option.choices[j])) continue;
      return definition_.choices[i] == static_cast<int>(j);
    }
  }
  return std::nullopt;
}

NodeId TextReader::value_of(const NamedExpression& constant) {
  const auto known = constants_.find(constant.name);
  if (known != constants_.end()) return known->second;
  const NodeId id = read_open(constant.name, constant.expression, {});
  constants_.emplace(constant.name, id);
  return id;
}

const NamedFunction* TextReader::find_function(const std::string& name) const {
  const auto found = std::ranges::find(definition_.functions, name, &NamedFunction::name);
  return found == definition_.functions.end() ? nullptr : &*found;
}

NodeId TextReader::value_of(const NamedFunction& function, const std::vector<NodeId>& arguments) {
  const auto call = std::pair(function.name, arguments);
  const auto known = calls_.find(call);
  if (known != calls_.end()) return known->second;
  if (calls_.size() == kMaxCalls) {
    fail_in(function.expression, 0,
            fmt::format("functions are called with more than {} arguments", kMaxCalls));
  }
  Arguments given;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    given[function.arguments[i]] = arguments[i];
  }
  const NodeId id = read_open(function.name, function.expression, given);
  calls_.emplace(call, id);
  return id;
}

void TextReader::read_by_itself(const NamedFunction& function) {
  std::vector<NodeId> arguments;
  for (const std::string& name : function.arguments) {
    // No name of a user's has a space.
    arguments.push_back(formula_.graph.symbol("argument " + name));
  }
  value_of(function, arguments);
}

NodeId TextReader::read_open(const std::string& name, const ExpressionText& text,
                             const Arguments& given) {
  const auto begun = std::ranges::find(open_, name);
  if (begun != open_.end()) {
    std::vector<std::string> way(begun, open_.end());
    way.push_back(name);
    fail_in(text, 0, fmt::format("'{}' is defined by itself: {}", name, fmt::join(way, " -> ")));
  }
  if (open_.size() == kMaxOpen) {
    fail_in(text, 0, fmt::format("definitions use each other more than {} deep", kMaxOpen));
  }
  open_.push_back(name);
  const NodeId id = read_with(text, given);
  open_.pop_back();
  return id;
}

std::vector<UnusedName> TextReader::unused() {
  std::vector<UnusedName> out;
  std::set<std::string> used;
  std::vector<std::string> ahead = {kModel};
  while (!ahead.empty()) {
    const std::string user = ahead.back();
    ahead.pop_back();
    for (const std::string& name : uses_[user]) {
      if (used.insert(name).second) ahead.push_back(name);
    }
  }
  const auto add = [&](const std::string& kind, const std::string& name,
                       const ExpressionText& text) {
    out.push_back({kind, name, fmt::format("{}:{}", text.file, text.line)});
  };
  for (std::size_t i = 0; i < definition_.parameters.size(); ++i) {
    const ExpressionText& symbol = definition_.symbols[i];
    if (!used.contains(symbol.text)) add("parameter", definition_.parameters[i].name, symbol);
  }
  for (const NamedExpression& constant : definition_.constants) {
    if (!used.contains(constant.name)) add("constant", constant.name, constant.expression);
  }
  for (const NamedFunction& function : definition_.functions) {
    if (!used.contains(function.name)) add("function", function.name, function.expression);
  }
  return out;
}

std::vector<std::string> TextReader::known_names() const {
  std::vector<std::string> known = {"phase"};
  for (const ChannelInfo& state : definition_.states) known.push_back(state.name);
  for (const ExpressionText& symbol : definition_.symbols) known.push_back(symbol.text);
  for (const std::string& choice : choice_names(definition_.options)) known.push_back(choice);
  for (const std::string& curve : definition_.curves) known.push_back(curve + ".given");
  if (formula_.turn) known.emplace_back("turn");
  for (const NamedExpression& constant : definition_.constants) known.push_back(constant.name);
  return known;
}

std::string TextReader::user() const { return open_.empty() ? kModel : open_.back(); }

}  // namespace gearsweep
