// What the lists of a model say: of its states, signals, parameters and options, and of the places
// where it bends, jumps or is looked at.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "model/expression_text.hpp"
#include "model/role.hpp"

namespace gearsweep {

// A state or a signal: `unit` in the model's dimensionless units.
struct ChannelInfo {
  std::string name, unit, meaning;
  Role role = Role::none;
  // The state that is the derivative of this state, by its equation; empty: none.
  std::string velocity = {};
  // The parameter that is the load of a signal with the role mesh_force, where it names one.
  std::string load = {};
  bool is_hidden = false;  // a signal that nobody looks at
};

struct ParameterInfo {
  std::string name, unit;
  double default_value = 0.0;
  double min = 0.0, max = 0.0;  // allowed range, both ends included
  bool shapes_phase = false;    // changes break phases or phase coefficients
  std::string meaning;
  Role role = Role::none;
};

struct OptionInfo {
  std::string name;
  std::vector<std::string> choices;  // the default first
  std::string meaning;
};

// By the names of parameters: what gives them, as "0.5*wn", where that is no number.
using ParameterExpressions = std::map<std::string, ExpressionText>;

// `toml` assigns parameters, options and the initial policy that differ from the defaults.
struct PresetInfo {
  std::string name, meaning, toml;
  ParameterExpressions expressions = {};  // of parameters that `toml` does not assign
};

// A parameter that an expression of others gives, at each point anew.
struct DerivedParameter {
  std::size_t parameter = 0;
  std::string expression, place;  // "0.5*wn", "impact.toml:12"
  std::vector<std::size_t> from;  // parameters with numbers of their own that it depends on
};

// A constant of a model's text. Of one that is a plain number a study may make a parameter.
struct ConstantInfo {
  std::string name;
  std::optional<double> number;
};

// A place where a force begins: at both limits of a backlash, or at the one limit of a stop. Its
// drive flank touches where the deflection D is beyond the backlash b', its back flank where D is
// below -b'.
struct ContactInfo {
  std::string name;  // its quantities begin with it; empty where it is a model's only one
  std::size_t deflection = 0, backlash = 0;  // signals
  bool is_one_sided = false;                 // it has the drive flank alone
};

// A place where an equation jumps with a state, as sign(v) does, and at which steps are not cut.
struct StateJump {
  std::string expression;  // "sign(v)"
  std::string place;       // "the equation of v, dry.toml:12"
};

// A place at which steps are cut: where its level is 0, or, of a staircase, a whole number. The
// equations jump there, or the state is reset where the level goes from below to above.
struct SurfaceInfo {
  std::string name;               // of one where the state is reset
  std::string expression, place;  // of another one, as of StateJump
  bool is_staircase = false;
  bool resets = false;
};

// A place that a motion is looked at where it comes up through it, and nothing happens.
struct SectionInfo {
  std::string name;   // its quantities begin with it
  std::string place;  // "where x is largest", "where v goes up through 0"
  // Signals: the level is 0 there; its rate along the motion; the size of its terms, whose rounding
  // the level must leave.
  std::size_t level = 0, rate = 0, size = 0;
  bool is_own = false;  // of no file: the maxima of a state (Binding::looked_at)
};

}  // namespace gearsweep
