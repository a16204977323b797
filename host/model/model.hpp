// A model as the host sees it: its lists, and its functions in double precision. make_model() makes
// it of a text of equations (equations/definition.hpp).
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "model/infos.hpp"
#include "model/known_answer.hpp"

namespace gearsweep {

// Parameter values in the model's order, and option choices (indices) in the model's order.
struct ModelSetting {
  std::vector<double> parameters;
  std::vector<int> options;
};

class PeriodicTable;  // expression/periodic_table.hpp

// What a study binds to a model: functions of the phase, measured or computed, by the names that
// the model gives them.
using Curves = std::map<std::string, std::shared_ptr<const PeriodicTable>, std::less<>>;

// What is worked out of all surfaces. A motion may stay at one: along a jump its level is held, at
// one where the state is reset the level's rate.
enum class SurfaceValue {
  level,                // [surface]
  level_gradient,       // by the states: [surface][state]
  level_drift,          // in dimensionless time, with the phase alone: [surface]
  held,                 // [surface]
  held_gradient,        // [surface][state]
  held_bend,            // the second derivative: [surface][state][state]
  held_drift,           // [surface]
  held_drift_gradient,  // [surface][state]
  reset,                // the state behind it: [surface][state]
  reset_gradient,       // [surface][state][state]
  reset_drift,          // [surface][state]
  turn                  // how a reset by a small rate changes the state: [surface][state]
};

// One flank's limit, or a corner of the equations: p = D - flank b' is 0 there.
struct ContactLimit {
  std::size_t contact = 0;  // of the model's contacts, then of its corners
  double flank = 1.0;       // 1: drive, which touches where p > 0; -1: back, where p < 0
};

// One point's right-hand side, with everything that does not change in time worked out.
class PreparedPoint {
 public:
  virtual ~PreparedPoint() = default;
  // Forcing period in dimensionless time.
  virtual double period() const = 0;
  // dx = dx/dtau; coefs: one row of phase coefficients; x, dx: one number per state.
  virtual void rhs(const double* coefs, const double* x, double* dx) const = 0;
  // out: row-major, out[i * states + j] = d(dx_i/dtau)/dx_j, from the model's own derivatives.
  virtual void jacobian(const double* coefs, const double* x, double* out) const = 0;
  // out: one number per signal.
  virtual void signals(const double* coefs, const double* x, double* out) const = 0;

  // out: deflection and backlash of each contact, then of each corner.
  virtual void contact_places(const double* coefs, const double* x, double* out) const = 0;
  // The force of a contact or corner. out: d(dx_i/dtau)/d(penetration), one number per state.
  virtual void force_direction(std::size_t contact, const double* coefs, const double* x,
                               double* out) const = 0;
  // out: row-major, how the force direction changes with each state.
  virtual void force_direction_slope(std::size_t contact, const double* coefs, const double* x,
                                     double* out) const = 0;
  // out: d(p)/dx_j at a limit, touching or not; one number per state.
  virtual void penetration_gradient(const ContactLimit& limit, const double* coefs, const double* x,
                                    double* out) const = 0;

  // The sides of the model's surfaces on which everything is worked out from now on, [surface]: 1
  // where the level is above 0, 0 below it; of a staircase the level's floor. Empty, as it begins:
  // the side that each x is on.
  virtual void hold(const std::vector<double>& sides) { (void)sides; }
  // out: row-major, as SurfaceValue says.
  virtual void of_surfaces(SurfaceValue value, const double* coefs, const double* x,
                           double* out) const {
    (void)value, (void)coefs, (void)x, (void)out;
  }
};

// Pairs of states that may mirror each other: while parameters come in equal pairs, the equilibrium
// has x[second] = -x[first], pair by pair, and a motion that once has it keeps it.
struct MirrorPairs {
  struct Pair {
    std::size_t first = 0, second = 0;
  };
  std::vector<Pair> states;
  std::vector<Pair> parameters;
};

// What a text of equations defines and neither an equation, a start, a signal, a jump nor the
// period depends on.
struct UnusedName {
  std::string kind;  // "parameter", "constant" or "function"
  std::string name;
  std::string place;  // "impact.toml:12"
};

// What a model is that stands for a larger one, with some of its states alone. Indices are those of
// the whole model, in its order.
struct Reduction {
  std::vector<std::size_t> kept;
  std::vector<std::size_t> passive;        // drive nothing that is kept
  std::vector<MirrorPairs::Pair> mirrors;  // x[second] = -x[first], where the first one is kept
  // The matrix, in column-major order, by which what is left out changes: the passive states, then
  // the sums x[first] + x[second] of mirrored ones.
  std::function<std::vector<double>(const ModelSetting&)> block;
};

// Floating-point operations of a model's equations: + - * / and each function 1, a comparison 1,
// choosing by it and a change of sign none.
struct StepWork {
  double of_state = 0.0;          // of one evaluation, what changes with the state
  double of_phase = 0.0;          // and what changes with the phase alone
  double of_linearization = 0.0;  // of the derivative at a state
  double of_tangent = 0.0;        // of that times one tangent vector
};

struct FieldGraph;  // equations/field_graph.hpp

// What a study makes of a model.
struct Binding {
  Curves curves;
  std::vector<int> options;          // the choices; kernels have nothing of the others
  std::set<std::string> parameters;  // in which points differ
  // What derived parameters follow from: the equations have these in their place.
  ParameterExpressions expressions = {};
  double clock = 1.0;  // of a model without forcing, in its time
  // The state whose maxima such a model is judged by, where its file names no section; nothing: the
  // first that moves.
  std::optional<std::size_t> looked_at = {};
  bool operator==(const Binding&) const = default;
};

// A phase psi in [0, 1], seen from the side of `inside`, a phase strictly between the break phases
// that enclose psi.
struct PhasePlace {
  double psi, inside;
};

struct Model {
  std::string name, summary;
  std::vector<std::string> assumptions;  // that its equations make, a sentence each
  std::vector<ChannelInfo> states, signals;
  std::vector<ParameterInfo> parameters;
  std::vector<OptionInfo> options;
  std::vector<PresetInfo> presets;
  std::vector<KnownAnswer> answers;  // of a model that was read from its file
  std::vector<std::string> curves;   // names of those that a study may give
  // Gear pairs whose drawing a study may give: [gear.first]. In what follows from one, names of
  // the model end in its name: eps_first.
  std::vector<std::string> drawings;
  // The one of them in whose b_n, k0 and varpi the model is; empty: it does not say.
  std::string unit_drawing;
  std::vector<ConstantInfo> constants;  // but for those that are parameters
  std::vector<DerivedParameter> derived;
  std::vector<ChannelInfo> phase_coefs;
  std::vector<std::size_t> angles;  // states, in radians, that mean the same after a full turn
  // How many of the last states are phases of further frequencies: angles that turn steadily,
  // whatever all else does. Tangent vectors have nothing along them, so their exponents, which are
  // 0, do not count.
  std::size_t clocks = 0;
  bool is_autonomous = false;  // no equation depends on the phase
  // Its file has no [forcing]: time is cut into periods of Binding::clock.
  bool is_clockless = false;
  // [state] Distances between states are relative to the range of the motion, state by state.
  // States of the same number share the largest of their ranges.
  std::vector<std::size_t> range_groups;
  // [state] A motion that goes beyond it has diverged; infinity: one that is no number any more.
  std::vector<double> diverged_above;
  std::vector<ContactInfo> contacts;
  // Corners of the equations, as of abs(x): one-sided contacts that steps are corrected for, and
  // that nobody looks at.
  std::size_t corners = 0;
  // Corners with a state that steps are not corrected for; a line each says which, and why.
  std::vector<std::string> uncorrected;
  std::vector<SurfaceInfo> surfaces;
  std::vector<SectionInfo> sections;
  std::vector<MirrorPairs> mirror_pairs;
  // A table bends inside the steps: nothing is read between the moments of a step.
  bool is_rough = false;
  // Set in a reduced model, whose states and angles are those that are kept. Its functions below
  // take and give the states of the whole model.
  const Model* whole = nullptr;
  Reduction reduction;
  // The longest step of a study that names none, in the model's time: at this the Lyapunov
  // exponents of the presets, and of parameters between half and twice theirs, are those at a
  // quarter of it, to within three standard errors of a mean over 32,000 periods, or to a
  // thousandth of the largest of them. 0: the model brings none, so each study finds its own
  // (study/own_step.hpp).
  double max_step = 0.0;
  // The text of its equations, the header for the device compiler that is made of it, and what the
  // program found in it, a line each: what a motion's accuracy rests on, and how the phase is dealt
  // with.
  std::string text, kernel;
  std::vector<std::string> findings, phase_findings;
  StepWork work;
  std::shared_ptr<const FieldGraph> field;  // of its equations; see field_of()
  std::vector<UnusedName> unused;

  // What is wrong with a setting whose ranges are right, and with what derived parameters come to;
  // empty if nothing.
  std::function<std::string(const ModelSetting&)> check;
  // Gives derived parameters their values of a setting. The functions here go without: the
  // equations have the expressions. Who reads a setting's parameters needs it.
  std::function<void(ModelSetting*)> derive = [](ModelSetting*) {};
  // What whoever gave a setting that is right may not expect of it; empty where a model never says
  // so. Throws as break_phases does.
  std::function<std::vector<std::string>(const ModelSetting&)> notices;
  // Phases in [0, 1) at which the right-hand side jumps or has a corner; unsorted, may repeat.
  // Throws InputError where they cannot be told, or are too many.
  std::function<std::vector<double>(const ModelSetting&)> break_phases;
  // Writes a row (phase_coefs.size() numbers) for each place.
  std::function<void(const ModelSetting&, std::span<const PhasePlace>, double* rows)> phase_table;
  void phase_coefs_at(const ModelSetting& setting, double psi, double inside, double* row) const {
    phase_table(setting, {{{psi, inside}}}, row);
  }
  // The same for phases of one setting that are asked for one after the other; for one thread.
  using PhaseRow = std::function<void(double psi, double inside, double* row)>;
  std::function<PhaseRow(const ModelSetting&)> phase_rows;
  // The static equilibrium, one number per state: where the policy "shifted" starts.
  std::function<std::vector<double>(const ModelSetting&)> equilibrium;
  std::function<std::unique_ptr<PreparedPoint>(const ModelSetting&)> prepare;
  // What it was made for, and the same model for another study.
  Binding binding;
  std::function<Model(const Binding&)> bound;
  // Where the equations jump with a state and steps are not cut, with the options of a setting.
  // Steps are of first order there, and tangents miss what a jump does to them.
  std::function<std::vector<StateJump>(const ModelSetting&)> state_jumps = [](const ModelSetting&) {
    return std::vector<StateJump>();
  };
  // As of prepare(), without the rest: a plan asks for each point of a study.
  std::function<double(const ModelSetting&)> period;
  // How many times the phase of the equations begins anew in that; empty: once.
  std::function<double(const ModelSetting&)> cycle;
  std::vector<std::size_t> cycle_parameters;  // that this depends on

  // Whether anything depends on a parameter: false of those in `unused`.
  bool uses_parameter(std::string_view parameter) const;

  // Index of a name, or -1.
  int find_parameter(std::string_view parameter) const;
  int find_state(std::string_view state) const;
  int find_signal(std::string_view signal) const;
  int find_option(std::string_view option) const;

  std::vector<std::string> state_names() const;
  // Those that a perturbation may change: all but the clocks.
  std::size_t perturbed_states() const { return states.size() - clocks; }
  // False of a state that has diverged.
  bool is_within_limits(std::span<const double> state) const;
  // What a state or signal is called in the kernels.
  std::string name_in_kernel(const std::string& channel) const;
  // The limits of all contacts, in their order, the drive flank's first; then those of the corners.
  std::vector<ContactLimit> contact_limits() const;
  // nullptr of a parameter that has a number of its own.
  const DerivedParameter* find_derived(std::size_t parameter) const;
  // Index of the parameter of a role.
  std::optional<std::size_t> parameter_of(Role role) const;
  // In their order.
  std::vector<ChannelInfo> signals_of(Role role) const;
  // The force between the teeth, of several the first; nullptr of a model that has none.
  const ChannelInfo* contact_force() const;
  // Mesh periods in a forcing period: its cycle.
  double mesh_periods(const ModelSetting& setting) const;

  ModelSetting default_setting() const;

  // The model whose states its functions take: this one, or the whole one.
  const Model& full() const { return whole == nullptr ? *this : *whole; }
  // This model, a whole one that outlives the result, with the states that are kept.
  Model reduced(const Reduction& reduction) const;
  // A state of the whole model as one of this.
  std::vector<double> own_state(const std::vector<double>& state_of_whole) const;
};

}  // namespace gearsweep
