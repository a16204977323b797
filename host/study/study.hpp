// A study: what to compute. Read from TOML and checked, so that what holds a Study can rely on it.
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "gear/datum.hpp"
#include "gear/dynamic_factor.hpp"
#include "gear/scales.hpp"
#include "model/model.hpp"
#include "study/initial_policy.hpp"
#include "study/load_spectrum.hpp"
#include "study/point_table.hpp"
#include "study/selection.hpp"
#include "study/uncertain.hpp"

namespace gearsweep {

// A parameter or an initial state of the model, and the values that it is given.
struct Swept {
  std::string name, unit, meaning;
  bool is_state = false;
  std::size_t index = 0;  // of the parameter or state in the model
  std::vector<double> values;
  // The columns, keys of [gear], that a parameter of a list follows from.
  std::string follows;
};

// A direction of the map: one swept quantity with increasing values, or what stands for several,
// which are its columns, with a value for each of its own. Those are the numbers 1, 2, 3, ... of a
// list of points, whose neighbours have nothing in common, or values of a key of [gear], from which
// the columns follow.
struct Axis : Swept {
  bool logarithmic = false;
  bool is_list = false;
  std::vector<Swept> columns;
  // The columns of a list that the model does not have: keys of [gear], from which columns follow,
  // and the share of time of each point. Then the names of all, in the list's order.
  std::vector<Swept> others;
  std::vector<std::string> listed;

  // The column of a list, or one that follows from it; nullptr where there is none of this name.
  const Swept* find_column(const std::string& column) const;
  // What has a value at each place: the axis itself, or its columns.
  std::span<const Swept> swept() const;
  bool sweeps_state() const;
  // The same axis at some of its places.
  Axis at(const std::vector<std::size_t>& places) const;
};

// Its draws are the values of an axis: of one parameter, or of those that follow from a key of
// [gear].
struct UncertainParameter {
  Axis draws;
  // A draw is a factor of the point's own value, which an axis may give.
  bool is_factor = false;
};

struct Study;

// An axis of one value, which changes nothing: of the first parameter that is the same at all
// points. For a study without axes, whose only point is its own setting.
Axis resting_axis(const Study& study);

// The name of the axis that a list of points makes.
inline constexpr const char* kPointAxis = "point";

struct Initial {
  InitialPolicy policy = InitialPolicy::shifted;
  std::vector<double> state;  // of policy fixed, one per state of the model
  std::size_t along = 0;      // axis index, of policies that go on from a neighbour
  // Trajectories of each point: the first starts as above, the others at seeded random places of
  // the box that reaches `spread` to both sides of that, state by state.
  std::size_t ensemble = 1;
  std::size_t seed = 1;
  std::vector<double> spread;  // one per state of the model
};

enum class EngineKind { opencl, reference };

// Whether a point that settles on a periodic orbit stops there, or runs on to the end.
enum class Stop { orbit, never };

// Whether states that drive nothing that is looked at are left out (plan/passive_states.hpp).
enum class States { driving, all };

// How to integrate.
struct Integrate {
  bool fp64 = true;
  // Largest step in the model's time, when steps_per_period = 0; the model's own by default, or
  // what the study finds for a model that has none (study/own_step.hpp).
  double max_step = 0.0;
  // > 0: a pilot run finds the longest max_step that keeps this share of each map's range
  // (sweep/pilot.hpp). One that is not asked for yields: where no pilot run pays or tells, max_step
  // is the model's own.
  double tolerance = 0.0;
  double exponent_tolerance = 0.0;      // the same for maps of exponents
  bool is_tolerance_asked = false;      // one of the two is in the study
  bool is_map_tolerance_given = false;  // the first one is
  std::size_t steps_per_period = 0;     // at least so many steps per period, when > 0
  // Steps of a motion on its periodic orbit for one of the run: what is told of a point that stops
  // there is as right as so much shorter steps make it.
  std::size_t orbit_steps = 1;
  bool events = true;         // steps that cross a contact's limit are corrected
  std::size_t settle = 400;   // periods
  std::size_t record = 200;   // periods
  std::size_t warm_up = 100;  // last periods of settle that tangent vectors are turned in
  std::size_t extend = 16;    // an undecided point is recorded for up to so many records
  Stop stop = Stop::orbit;
  States states = States::driving;
  EngineKind engine = EngineKind::opencl;
  // Four that never change a result, only how it is computed; 0: the engine chooses.
  std::size_t lanes = 0;       // points per work-item
  std::size_t tile = 0;        // points per tile
  std::size_t local_size = 0;  // work-items per work-group
  std::size_t round = 0;       // periods per kernel launch
  bool contract = true;        // fused multiply-add allowed: other rounding
};

// Where some motions have been.
struct MotionReach {
  std::vector<double> low, high;  // [state]
};

// What the origin of a parameter begins with whose value is a guess.
inline constexpr std::string_view kEstimatedOrigin = "estimated";

struct Study {
  std::string title;
  const Model* model = nullptr;
  std::shared_ptr<const Model> own_model;  // what `model` points to, where no other owns it
  std::string preset;
  // What every point has before the axes. Derived parameters have what they come to here.
  ModelSetting setting;
  // What derived parameters follow from: the model is bound to them.
  ParameterExpressions expressions;
  // "preset coarse", "study.toml:12", "estimated, study.toml:12", one per parameter.
  std::vector<std::string> parameter_origins;
  std::vector<std::string> option_origins;
  std::vector<std::string> gear_notes;               // how each number of a [gear] table came about
  std::vector<GearDatum> gear_data;                  // and what its numbers rest on
  Scales scales;                                     // of a study with a [gear] table
  std::optional<DynamicFactorInput> dynamic_factor;  // of a [gear] table with what K_v takes
  std::vector<Axis> axes;                            // one or two; the first is x, the fastest
  std::optional<LoadSpectrum> spectrum;              // of a list of points that is one
  Initial initial;
  Uncertain uncertain;
  Integrate integrate;
  std::string step_reason;   // of a max_step that the study found; empty: it was given
  MotionReach step_reach;    // where the motions were that it was found by; empty: it was given
  std::string clock_reason;  // what a period is, of a model without a clock
  Selection selection;
  std::string toml;  // the whole study as TOML, overrides included: reading it gives this study
  // What the model's equations leave of the steps' fourth order; empty where that holds.
  std::string accuracy;
  // What whoever gave it may not expect, such as which of two values wins: one line each, with the
  // place.
  std::vector<std::string> notices;

  // `toml` without the numbers of a list of points.
  std::string brief_toml() const;
  std::size_t points() const;
  // The place on an axis of a point, or of any trajectory of it, and the value there.
  std::size_t axis_index(std::size_t axis, std::size_t point) const;
  double axis_value(std::size_t axis, std::size_t point) const;
  // The parameters and initial states that differ from point to point, or from draw to draw.
  std::vector<const Swept*> swept() const;
  // The one of them that is this parameter or initial state; nullptr if it is the same everywhere.
  const Swept* find_swept(bool is_state, std::size_t index) const;
  // The one of the axes' own that is this parameter; nullptr if no axis has it.
  const Swept* find_on_axes(std::size_t parameter) const;
  // Whether points differ in this parameter: it is swept, or derived from one that is.
  bool differs(std::size_t parameter) const;
  // The same model for another binding.
  void bind(const Binding& binding);
  // A number, that of the setting, takes the place of the parameter's expression, if it has one.
  void release(std::size_t parameter);
  // Whether points go on from their neighbours.
  bool is_chained() const { return info_of(initial.policy).neighbour != 0; }
  // Points of a later stage start from the final states of those of an earlier one: a place along
  // the axis of a chain each, or the nominal points and their draws. 1: all start on their own.
  std::size_t stages() const;
  // Takes uncertain parameters as they are without their tolerances.
  void take_nominal();
  // Makes each point start on its own, and once: without chain, ensemble or draws.
  void separate_points();
  // How many each point has: the members of an ensemble, or the nominal parameters and their draws.
  std::size_t members() const { return initial.ensemble + uncertain.draws(); }
  std::size_t trajectories() const { return points() * members(); }
};

// Whether the text of a study may name files beside it. That of a result may not: it comes from
// whoever made the result, and what it needs of files is in it.
enum class NamedFiles { allowed, refused };

// Makes a study from TOML text. cli/ finds the text: a file, the study in a result file, a built-in
// study. `source` names it in messages.
// Each override is "path=value", as in "integrate.record=20" or "axes.omega.count=40". Each zoom,
// applied after these, is "axis=from:to" or "axis=from:to:count". `points`, unless empty, is the
// study's list of points in place of what its [points] says. Overrides may always name files.
// Throws InputError.
Study read_study(const std::string& text, const std::string& source,
                 const std::vector<std::string>& overrides = {},
                 const std::vector<std::string>& zooms = {}, const PointTable& points = {},
                 NamedFiles files = NamedFiles::allowed);

}  // namespace gearsweep
