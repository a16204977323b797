// The types that every model has, made from its lists, and defaults. A model file defines
// MODEL_STATES, MODEL_PARAMETERS, MODEL_SIGNALS and, when it has any, MODEL_PHASE_COEFS,
// MODEL_OPTIONS, MODEL_CURVES (what may be measured), MODEL_ANGLES (X(state) of each that means the
// same after a full turn, in radians), MODEL_RANGE_GROUPS (X(states), names that share the largest
// of their ranges where distances between states are measured), MODEL_DIVERGED_ABOVE (a state
// beyond it has diverged) and MODEL_MIRROR_PAIRS (X(states, parameters), names pair after pair:
// while both parameters of each pair are equal, a motion with the second state of each pair the
// negative of the first keeps that), then includes this file, then defines its functions. No
// include guard: the host includes each model into a namespace of its own.

#include "functions.h"

#define MODEL_STATE_INDEX(name, unit, meaning) STATE_##name,
#define MODEL_PARAMETER_FIELD(name, unit, value, min, max, shapes_phase, meaning) real name;
#define MODEL_OPTION_FIELD(name, choices, meaning) int name;
#define MODEL_SIGNAL_FIELD(name, unit, meaning) real name;
#define MODEL_PHASE_COEF_FIELD(name, meaning) scalar name;

enum { MODEL_STATES(MODEL_STATE_INDEX) MODEL_STATE_COUNT };

typedef struct {
  MODEL_PARAMETERS(MODEL_PARAMETER_FIELD)
} ModelParameters;
#ifdef MODEL_OPTIONS
typedef struct {
  MODEL_OPTIONS(MODEL_OPTION_FIELD)
} ModelOptions;
#else
#define MODEL_OPTIONS(X)
typedef struct {
  int none;  // a struct must have a member
} ModelOptions;
#endif
#ifndef MODEL_PHASE_COEFS
#define MODEL_AUTONOMOUS
#define MODEL_PHASE_COEFS(X) X(one, "1: nothing depends on the phase")
#endif
#ifndef MODEL_ANGLES
#define MODEL_ANGLES(X)
#endif
#ifndef MODEL_RANGE_GROUPS
#define MODEL_RANGE_GROUPS(X)
#endif
#ifndef MODEL_DIVERGED_ABOVE
#define MODEL_DIVERGED_ABOVE INFINITY
#endif
#define MODEL_TAKE_TURNS(name) \
  x[STATE_##name] = x[STATE_##name] - turn * lane_rint(x[STATE_##name] / turn);

// Takes the full turns out of the angles of a state or of the difference of two: they are between
// -pi and pi then. Nothing else changes.
SHARED_FN void model_take_turns(real* x) {
  const real turn = (scalar)(TWO_PI);
  (void)turn;
  (void)x;
  MODEL_ANGLES(MODEL_TAKE_TURNS)
}

typedef struct {
  MODEL_SIGNALS(MODEL_SIGNAL_FIELD)
} ModelSignals;
#ifdef ORDER_COUNT
// Cosine and sine of each order's angle at a phase, of studies that ask for orders
// (observables/orders.h).
typedef struct {
  scalar cosine[ORDER_COUNT], sine[ORDER_COUNT];
} OrderPhases;
#endif
typedef struct {
  MODEL_PHASE_COEFS(MODEL_PHASE_COEF_FIELD)
#ifdef ORDER_COUNT
  OrderPhases orders;
#endif
} PhaseCoefs;

#ifdef MODEL_CONTACT
// Where a contact stands: the drive flank touches while backlash < deflection, the back flank
// while deflection < -backlash; while a backlash is negative, both may.
typedef struct {
  real deflection, backlash;
} ModelContact;

// A model may have several contacts; those that have the drive flank alone are one-sided.
#ifndef MODEL_CONTACTS
#define MODEL_CONTACTS 1
#define MODEL_ONE_SIDED(contact) 0
// X(contact, signals: deflection, backlash)
#define MODEL_CONTACT_SIGNALS(X) X(0, deflection, backlash)
#endif
#endif

#ifdef MODEL_HOST_PART
// X(name, meaning) of each curve that a study may measure (Curve of the host). Functions that take
// such a model's curves have them as their last argument.
#ifdef MODEL_CURVES
#define MODEL_CURVE_FIELD(name, meaning) Curve name;
struct ModelCurves {
  MODEL_CURVES(MODEL_CURVE_FIELD)
};
#endif

// What holds for most models. A model for which it does not defines a function of the same name,
// which the compiler prefers to these templates.

// All parameters go together; otherwise it says what is wrong.
template <class Parameters, class Options>
std::string model_check(const Parameters&, const Options&) {
  return "";
}

// Nothing jumps within a period.
template <class Parameters, class Options>
std::vector<double> model_break_phases(const Parameters&, const Options&) {
  return {0.0};
}

// At rest without forcing, all states are zero.
template <class Parameters, class Options>
void model_equilibrium(const Parameters&, const Options&, double* x) {
  for (int i = 0; i < MODEL_STATE_COUNT; ++i) x[i] = 0.0;
}

#ifdef MODEL_AUTONOMOUS
template <class Parameters, class Options>
PhaseCoefs model_phase_coefs(const Parameters&, const Options&, double, double) {
  return {1.0};
}
#endif
#endif
