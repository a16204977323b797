// The types that every model has, made from its lists. A model file defines MODEL_STATES,
// MODEL_PARAMETERS, MODEL_SIGNALS, MODEL_PHASE_COEFS and, when it has any, MODEL_OPTIONS and
// MODEL_ANGLES (X(state) of each that means the same after a full turn, in radians), then includes
// this file, then defines its functions. No include guard: the host includes each model
// into a namespace of its own.

#define MODEL_STATE_INDEX(name, unit, meaning) STATE_##name,
#define MODEL_PARAMETER_FIELD(name, unit, value, least, greatest, shapes_phase, meaning) real name;
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
#ifndef MODEL_ANGLES
#define MODEL_ANGLES(X)
#endif
#define MODEL_TAKE_TURNS(name) \
  x[STATE_##name] = x[STATE_##name] - turn * lane_rint(x[STATE_##name] / turn);

// Takes the full turns out of the angles of a state or of the difference of two: they are between
// -pi and pi then. Nothing else changes.
SHARED_FN void model_take_turns(real* x) {
  const real turn = (scalar)(6.283185307179586476925);
  (void)turn;
  (void)x;
  MODEL_ANGLES(MODEL_TAKE_TURNS)
}

typedef struct {
  MODEL_SIGNALS(MODEL_SIGNAL_FIELD)
} ModelSignals;
typedef struct {
  MODEL_PHASE_COEFS(MODEL_PHASE_COEF_FIELD)
} PhaseCoefs;

#ifdef MODEL_CONTACT
// Where the contact stands: the drive flank touches while backlash < deflection, the back flank
// while deflection < -backlash; while a backlash is negative, both may.
typedef struct {
  real deflection, backlash;
} ModelContact;
#endif
