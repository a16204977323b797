// The types that every model has, made from its lists, and defaults. The header that is written for
// a model defines MODEL_STATES, MODEL_SIGNALS and, when it has any, MODEL_PARAMETERS,
// MODEL_PHASE_COEFS, MODEL_OPTIONS, MODEL_ANGLES (X(state) of each that means the same after a full
// turn, in radians), MODEL_CLOCKS (how many of the last states turn steadily, whatever the
// others do) and MODEL_CLOCKLESS (nothing drives it: a period is a count of time), then includes
// this file, then defines its functions. No include guard: the host includes a model into a
// namespace of its own.

#include "functions.h"

#define MODEL_STATE_INDEX(name, unit, meaning) STATE_##name,
#define MODEL_PARAMETER_FIELD(name, unit, value, min, max, shapes_phase, meaning) real name;
#define MODEL_OPTION_FIELD(name, choices, meaning) int name;
#define MODEL_SIGNAL_FIELD(name, unit, meaning) real name;
#define MODEL_PHASE_COEF_FIELD(name, meaning) scalar name;

enum { MODEL_STATES(MODEL_STATE_INDEX) MODEL_STATE_COUNT };

#ifdef MODEL_PARAMETERS
typedef struct {
  MODEL_PARAMETERS(MODEL_PARAMETER_FIELD)
} ModelParameters;
#else
#define MODEL_PARAMETERS(X)
typedef struct {
  int none;  // a struct must have a member
} ModelParameters;
#endif
#ifdef MODEL_OPTIONS
typedef struct {
  MODEL_OPTIONS(MODEL_OPTION_FIELD)
} ModelOptions;
#else
#define MODEL_OPTIONS(X)
typedef struct {
  int none;
} ModelOptions;
#endif
#ifndef MODEL_PHASE_COEFS
#define MODEL_AUTONOMOUS
#define MODEL_PHASE_COEFS(X) X(one, "1: nothing depends on the phase")
#endif
#ifndef MODEL_ANGLES
#define MODEL_ANGLES(X)
#endif
#ifndef MODEL_CLOCKS
#define MODEL_CLOCKS 0
#endif
#define MODEL_COUNT_ANGLE(name) +1
#define MODEL_TAKE_TURNS(name) \
  x[STATE_##name] = x[STATE_##name] - turn * lane_rint(x[STATE_##name] / turn);

enum { MODEL_ANGLE_COUNT = 0 MODEL_ANGLES(MODEL_COUNT_ANGLE) };

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
#ifdef MODEL_SURFACES
typedef struct {
  real cosine[ORDER_COUNT], sine[ORDER_COUNT];
} OrdersAt;
#else
typedef OrderPhases OrdersAt;
#endif
#endif
typedef struct {
  MODEL_PHASE_COEFS(MODEL_PHASE_COEF_FIELD)
#ifdef ORDER_COUNT
  OrderPhases orders;
#endif
} PhaseCoefs;

#ifdef MODEL_SURFACES
// The sides of the surfaces, on which the equations jump, that a motion is held on. A surface's
// level is 0 there, or, of a staircase, a whole number.
typedef struct {
  real side[MODEL_SURFACES];    // 1 above, 0 below; of a staircase the level's floor
  mask slides[MODEL_SURFACES];  // it slides along the surface: `side` is the one above
  mask slid;                    // it began to slide, or was reset, since this was last cleared
} Sides;

// Which surfaces have reset the state; how fast their levels rose there, what their own resets made
// of that, and whether the levels stayed what they were.
typedef struct {
  mask hit[MODEL_SURFACES];
  real rate[MODEL_SURFACES];
  real behind[MODEL_SURFACES];
  mask in_place[MODEL_SURFACES];
} SurfaceMet;

// Phase coefficients at a moment of a lane's own.
#define MODEL_PHASE_AT_FIELD(name, meaning) real name;
#define MODEL_TAKE_PHASE(name, meaning) at.name = row->name;
typedef struct {
  MODEL_PHASE_COEFS(MODEL_PHASE_AT_FIELD)
} PhaseAt;

SHARED_FN PhaseAt phase_at(const PhaseCoefs* row) {
  PhaseAt at;
  MODEL_PHASE_COEFS(MODEL_TAKE_PHASE)
  return at;
}
#else
typedef PhaseCoefs PhaseAt;
#define phase_at(row) (*(row))
#endif

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
