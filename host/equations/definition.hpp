// A model as its file defines it: lists of names, and expressions as text with their places.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "equations/expression_text.hpp"
#include "expression/periodic_table.hpp"
#include "model/model.hpp"

namespace gearsweep {

// The points of the table in a file, as PeriodicTable wants them. Throws InputError. Empty where a
// model may read no tables.
using TablePoints = std::function<std::vector<TablePoint>(const std::string& file)>;

struct NamedExpression {
  std::string name;
  ExpressionText expression;
};

// "hertz(p)" = "max(p, 0)^1.5"
struct NamedFunction {
  std::string name;
  std::vector<std::string> arguments;
  ExpressionText expression;  // of its arguments, and of all else that expressions may use
};

// "rho_p + rho_g must be 1" = "abs(rho_p + rho_g - 1) <= 1e-6"
struct ModelCheck {
  std::string message;       // {expression} in it stands for its value
  ExpressionText condition;  // of parameters, choices and curves
};

// [surfaces.wall]: where `when` goes from below 0 to above it, the state is reset.
struct SurfaceDefinition {
  std::string name;
  ExpressionText when;
  std::vector<ExpressionText> reset;  // [state]
};

// [sections.top]: where `value`, or its rate along the motion, goes from below 0 to above it; with
// is_down from above to below.
struct SectionDefinition {
  std::string name;
  ExpressionText value;
  bool of_rate = false, is_down = false;
  auto operator<=>(const SectionDefinition&) const = default;
};

struct ModelDefinition {
  std::string name, summary;
  std::vector<std::string> assumptions;  // of Model
  std::vector<ChannelInfo> states, signals;
  std::vector<bool> are_angles;           // [state]
  std::vector<std::string> groups;        // [state] that share their ranges; empty: of none
  std::vector<double> diverged_above;     // [state] as in Model
  std::vector<ParameterInfo> parameters;  // shapes_phase: found by make_model()
  std::vector<ExpressionText> symbols;    // [parameter]: its name in expressions
  // What parameters without a number of their own follow from: by their names, in symbols of the
  // others.
  ParameterExpressions expressions;
  // `option.choice` is a condition in expressions.
  std::vector<OptionInfo> options;
  std::vector<int> choices;           // [option]: those that are made; empty: none is made yet
  std::vector<std::string> curves;    // names: name(phase) is its value, name.given a condition
  std::vector<std::string> drawings;  // of Model
  std::string unit_drawing;           // of Model
  std::vector<ConstantInfo> constant_infos;  // of Model
  Curves given_curves;                       // those that are measured; another one is 0 everywhere
  std::vector<ModelCheck> checks;
  std::vector<MirrorPairs> mirrors;
  std::vector<PresetInfo> presets;
  std::vector<NamedFunction> functions;       // used by what follows, and by each other
  std::vector<NamedExpression> constants;     // the same
  std::vector<ExpressionText> equations;      // [state]
  std::vector<ExpressionText> start;          // [state]; of parameters alone
  std::vector<ExpressionText> signal_values;  // [signal]
  std::vector<SurfaceDefinition> surfaces;
  std::vector<SectionDefinition> sections;
  ExpressionText period;  // in dimensionless time; of parameters alone
  // What the time of a model without forcing is counted in, of which `period` is the text.
  std::optional<double> clock;
  std::optional<std::size_t> looked_at = {};  // Binding::looked_at
  // The rate of the last state, `phase2`, of parameters alone. Empty: there is no such state.
  std::optional<ExpressionText> second;
  // How many of these make a period of the forcing, whole, of parameters alone: `turn` counts them
  // from 0 on, and `phase` begins anew in each. Empty: one.
  std::optional<ExpressionText> cycle;
  std::vector<ExpressionText> jumps;  // phases, in radians; of parameters alone
  double max_step = 0.0;              // 0: none (Model::max_step)
  // Parameters in which the points of a study differ: what depends on the phase and on none of
  // these is tabulated whole.
  std::set<std::string> swept;
  TablePoints table_points;
  std::string text;  // of the whole file
};

// The expressions that presets give to parameters. Throws InputError as make_model() does.
void check_presets(const ModelDefinition& definition);

// Throws InputError with file, line, column and a caret under the place.
Model make_model(const ModelDefinition& definition);

}  // namespace gearsweep
