#include "equations/detail/formula.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>

#include "equations/detail/check_message.hpp"
#include "equations/detail/tables.hpp"
#include "expression/parse.hpp"
#include "model/names.hpp"

namespace gearsweep {
namespace {

const char* const kModel = "";  // no name of a constant
// Texts are read within texts, each some levels deep: so many, and so much less deep each time.
constexpr std::size_t kMaxOpen = 15, kLessDepth = 16;
constexpr std::size_t kMaxCalls = 4000;  // of functions

class FormulaReader {
 public:
  explicit FormulaReader(const ModelDefinition& definition)
      : definition_(definition), tables_(definition.table_points) {}

  Formula run() {
    for (const ChannelInfo& state : definition_.states) {
      formula_.states.push_back(formula_.graph.symbol(state.name));
    }
    for (std::size_t i = 0; i < definition_.parameters.size(); ++i) {
      const ParameterInfo& parameter = definition_.parameters[i];
      formula_.parameters.push_back(formula_.graph.symbol(definition_.symbols[i].text));
      formula_.are_negative.push_back(parameter.min < 0.0);
      formula_.are_swept.push_back(definition_.swept.contains(parameter.name));
      const auto given = definition_.expressions.find(parameter.name);
      if (given == definition_.expressions.end()) continue;
      derived_.emplace(definition_.symbols[i].text,
                       Derived{i, {definition_.symbols[i].text, given->second}});
    }
    if (definition_.choices.empty()) {
      for (const std::string& name : choice_names()) {
        formula_.choices.push_back(formula_.graph.symbol(name));
      }
    }
    formula_.phase = formula_.graph.symbol("phase");
    if (definition_.cycle) formula_.turn = formula_.graph.symbol("turn");
    // Those that nothing uses, too: a mistake in one is a mistake.
    for (const auto& [symbol, derived] : derived_) {
      const std::string what =
          fmt::format("the parameter '{}'", definition_.parameters[derived.parameter].name);
      const ExpressionText& text = derived.constant.expression;
      formula_.derived.emplace_back(derived.parameter,
                                    require_parameters(value_of(derived.constant), text, what));
    }
    for (const NamedFunction& function : definition_.functions) read_by_itself(function);
    for (const NamedExpression& constant : definition_.constants) value_of(constant);
    for (const ExpressionText& text : definition_.equations) {
      const bool is_clock =
          definition_.second && formula_.equations.size() + 1 == definition_.equations.size();
      formula_.equations.push_back(is_clock ? of_parameters(text, "the second frequency")
                                            : parse(text));
    }
    for (const ExpressionText& text : definition_.signal_values) {
      formula_.signals.push_back(parse(text));
    }
    for (const SurfaceDefinition& surface : definition_.surfaces) {
      formula_.impacts.push_back({surface.name, without_table(surface.when), {}});
      for (const ExpressionText& text : surface.reset) {
        formula_.impacts.back().reset.push_back(without_table(text));
      }
    }
    for (const SectionDefinition& section : definition_.sections) {
      formula_.sections.push_back({without_table(section.value), section.of_rate, section.is_down});
    }
    for (const ExpressionText& text : definition_.start) {
      formula_.start.push_back(of_parameters(text, "a start"));
    }
    for (const ExpressionText& text : definition_.jumps) {
      formula_.jumps.push_back(of_parameters(text, "a phase of a jump"));
    }
    formula_.period = of_parameters(definition_.period, "the period");
    formula_.cycle = formula_.graph.number(1.0);
    if (definition_.cycle) {
      formula_.cycle = of_parameters(*definition_.cycle, "the cycle");
      formula_.period =
          formula_.graph.as_written(Operation::multiply, {formula_.cycle, formula_.period});
    }
    for (const ModelCheck& check : definition_.checks) {
      formula_.checks.push_back(condition_of_parameters(check));
      formula_.check_values.push_back(values_in_message(check));
    }
    find_unused();
    formula_.constants.assign(constants_.begin(), constants_.end());
    return std::move(formula_);
  }

 private:
  using Arguments = std::map<std::string, NodeId>;  // of a function, by name
  // A parameter that is read as a constant is.
  struct Derived {
    std::size_t parameter;
    NamedExpression constant;
  };

  NodeId parse(const ExpressionText& text, const Arguments& given = {}) {
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

  NodeId of_parameters(const ExpressionText& text, const std::string& what) {
    return require_parameters(parse(text), text, what);
  }

  NodeId require_parameters(NodeId id, const ExpressionText& text, const std::string& what) const {
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

  // Its rate is needed, and how a table changes with the phase is not known.
  NodeId without_table(const ExpressionText& text) {
    const NodeId id = parse(text);
    for (const NodeId part : parts_of(formula_.graph, {id})) {
      if (formula_.graph[part].operation != Operation::table) continue;
      fail_in(text, 0, "a surface may read no table and no curve");
    }
    return id;
  }

  // As a number that is 1 where it holds.
  NodeId condition_of_parameters(const ModelCheck& check) {
    ExpressionText chosen = check.condition;
    const std::string before = "if(";
    chosen.text = fmt::format("{}{}, 1, 0)", before, chosen.text);
    chosen.column -= std::min(chosen.column, before.size());
    return of_parameters(chosen, "a check");
  }

  std::vector<NodeId> values_in_message(const ModelCheck& check) {
    std::vector<NodeId> values;
    for (const std::string& text : split_message(check.message).values) {
      const ExpressionText value = {text, check.condition.file, check.condition.line, 1};
      values.push_back(of_parameters(value, "a message"));
    }
    return values;
  }

  // One that is not measured is 0.
  NodeId curve_at(const std::string& name, NodeId argument, std::size_t position) {
    refuse_states({name, argument, Interpolation::linear, position, position}, formula_);
    const auto given = definition_.given_curves.find(name);
    if (given == definition_.given_curves.end()) return formula_.graph.number(0.0);
    return formula_.graph.table(given->second, argument, argument);
  }

  NodeId as_condition(bool holds) {
    const NodeId number = formula_.graph.number(holds ? 1.0 : 0.0);
    return formula_.graph.as_written(Operation::less, {formula_.graph.number(0.0), number});
  }

  std::optional<NodeId> find(const std::string& name) {
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

  // Whether a condition on choices that are made, or on curves, holds: option.choice and
  // curve.given.
  std::optional<bool> known_condition(const std::string& name) const {
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

  // The constant or function that is being read.
  std::string user() const { return open_.empty() ? kModel : open_.back(); }

  NodeId value_of(const NamedExpression& constant) {
    const auto known = constants_.find(constant.name);
    if (known != constants_.end()) return known->second;
    const NodeId id = read(constant.name, constant.expression, {});
    constants_.emplace(constant.name, id);
    return id;
  }

  const NamedFunction* find_function(const std::string& name) const {
    const auto found = std::ranges::find(definition_.functions, name, &NamedFunction::name);
    return found == definition_.functions.end() ? nullptr : &*found;
  }

  NodeId value_of(const NamedFunction& function, const std::vector<NodeId>& arguments) {
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
    const NodeId id = read(function.name, function.expression, given);
    calls_.emplace(call, id);
    return id;
  }

  void read_by_itself(const NamedFunction& function) {
    std::vector<NodeId> arguments;
    for (const std::string& name : function.arguments) {
      // No name of a user's has a space.
      arguments.push_back(formula_.graph.symbol("argument " + name));
    }
    value_of(function, arguments);
  }

  NodeId read(const std::string& name, const ExpressionText& text, const Arguments& given) {
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
    const NodeId id = parse(text, given);
    open_.pop_back();
    return id;
  }

  std::vector<std::string> choice_names() const {
    std::vector<std::string> names;
    for (const OptionInfo& option : definition_.options) {
      for (const std::string& choice : option.choices) {
        names.push_back(fmt::format("{}.{}", option.name, choice));
      }
    }
    return names;
  }

  // A parameter of a constant that nothing uses is used by nothing.
  void find_unused() {
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
      formula_.unused.push_back({kind, name, fmt::format("{}:{}", text.file, text.line)});
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
  }

  std::vector<std::string> known_names() const {
    std::vector<std::string> known = {"phase"};
    for (const ChannelInfo& state : definition_.states) known.push_back(state.name);
    for (const ExpressionText& symbol : definition_.symbols) known.push_back(symbol.text);
    for (const std::string& choice : choice_names()) known.push_back(choice);
    for (const std::string& curve : definition_.curves) known.push_back(curve + ".given");
    if (formula_.turn) known.emplace_back("turn");
    for (const NamedExpression& constant : definition_.constants) known.push_back(constant.name);
    return known;
  }

  const ModelDefinition& definition_;
  Formula formula_;
  Tables tables_;
  std::map<std::string, Derived> derived_;  // by their names in expressions
  std::map<std::string, NodeId> constants_;
  std::map<std::pair<std::string, std::vector<NodeId>>, NodeId> calls_;  // what each comes to
  std::vector<std::string> open_;  // constants and functions that are being read, outermost first
  // The names in each of these; under kModel those in all else.
  std::map<std::string, std::set<std::string>> uses_;
};

}  // namespace

Formula parse_formula(const ModelDefinition& definition) { return FormulaReader(definition).run(); }

void check_presets(const ModelDefinition& definition) {
  for (const PresetInfo& preset : definition.presets) {
    if (preset.expressions.empty()) continue;
    ModelDefinition with_it = definition;
    for (const auto& [name, text] : preset.expressions) with_it.expressions[name] = text;
    parse_formula(with_it);
  }
}

}  // namespace gearsweep
