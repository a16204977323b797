// A model with fewer states. What a study looks at is driven by some states alone; the others, and
// those that mirror one of these, are left out. The host writes, beside the model,
//   KEPT_STATES     the numbers of the states that are kept, as an initialiser
//   KEPT_COUNT      how many there are
//   WHOLE_STATE(x)  the whole model's state where the kept one is x, as an initialiser
// and includes this file. From here on the model has the kept states alone. Its functions still
// work out all of them; the compiler drops what nobody reads.

enum { WHOLE_STATE_COUNT = MODEL_STATE_COUNT };

SHARED_FN void reduced_keep(const real* whole, real* x) {
  const int kept[KEPT_COUNT] = KEPT_STATES;
  UNROLL
  for (int i = 0; i < KEPT_COUNT; ++i) x[i] = whole[kept[i]];
}

SHARED_FN void reduced_rhs(const ModelPoint* point, const PhaseAt* phase, const real* x, real* dx) {
  const real whole[WHOLE_STATE_COUNT] = WHOLE_STATE(x);
  real slope[WHOLE_STATE_COUNT];
  model_rhs(point, phase, whole, slope);
  reduced_keep(slope, dx);
}

SHARED_FN void reduced_linearize(const ModelPoint* point, const PhaseAt* phase, const real* x,
                                 real scale, ModelLinear* linear) {
  const real whole[WHOLE_STATE_COUNT] = WHOLE_STATE(x);
  model_linearize(point, phase, whole, scale, linear);
}

SHARED_FN void reduced_tangent(const ModelPoint* point, const ModelLinear* linear, const real* w,
                               const real* base, real* out) {
  const real whole_w[WHOLE_STATE_COUNT] = WHOLE_STATE(w);
  const real whole_base[WHOLE_STATE_COUNT] = WHOLE_STATE(base);
  real whole_out[WHOLE_STATE_COUNT];
  model_tangent(point, linear, whole_w, whole_base, whole_out);
  reduced_keep(whole_out, out);
}

SHARED_FN void reduced_signals(const ModelPoint* point, const PhaseAt* phase, const real* x,
                               ModelSignals* signals) {
  const real whole[WHOLE_STATE_COUNT] = WHOLE_STATE(x);
  model_signals(point, phase, whole, signals);
}

SHARED_FN void reduced_take_turns(real* x) {
  real whole[WHOLE_STATE_COUNT] = WHOLE_STATE(x);
  model_take_turns(whole);
  reduced_keep(whole, x);
}

#ifdef MODEL_SURFACES
SHARED_FN void reduced_level_values(const ModelPoint* point, const PhaseAt* phase, const real* x,
                                    real* levels) {
  const real whole[WHOLE_STATE_COUNT] = WHOLE_STATE(x);
  model_level_values(point, phase, whole, levels);
}

SHARED_FN void reduced_level_along(const ModelPoint* point, const PhaseAt* phase, const real* x,
                                   const real* dx, real* rates) {
  const real whole[WHOLE_STATE_COUNT] = WHOLE_STATE(x);
  const real whole_dx[WHOLE_STATE_COUNT] = WHOLE_STATE(dx);
  model_level_along(point, phase, whole, whole_dx, rates);
}

SHARED_FN void reduced_level_rates(const ModelPoint* point, const PhaseAt* phase, const real* x,
                                   const real* dx, real* rates) {
  const real whole[WHOLE_STATE_COUNT] = WHOLE_STATE(x);
  const real whole_dx[WHOLE_STATE_COUNT] = WHOLE_STATE(dx);
  model_level_rates(point, phase, whole, whole_dx, rates);
}

SHARED_FN void reduced_level_bends(const ModelPoint* point, const PhaseAt* phase, const real* x,
                                   const real* dx, const real* w, real* bends) {
  const real whole[WHOLE_STATE_COUNT] = WHOLE_STATE(x);
  const real whole_dx[WHOLE_STATE_COUNT] = WHOLE_STATE(dx);
  const real whole_w[WHOLE_STATE_COUNT] = WHOLE_STATE(w);
  model_level_bends(point, phase, whole, whole_dx, whole_w, bends);
}
#define model_level_values reduced_level_values
#define model_level_along reduced_level_along
#define model_level_rates reduced_level_rates
#define model_level_bends reduced_level_bends
#endif

#ifdef MODEL_CONTACT
SHARED_FN void reduced_contact(const ModelPoint* point, const PhaseAt* phase, const real* x,
                               ModelContact* contacts) {
  const real whole[WHOLE_STATE_COUNT] = WHOLE_STATE(x);
  model_contact(point, phase, whole, contacts);
}

SHARED_FN void reduced_rhs_in_contact(const ModelPoint* point, const PhaseAt* phase, const real* x,
                                      const ModelContact* contacts, real* dx) {
  const real whole[WHOLE_STATE_COUNT] = WHOLE_STATE(x);
  real slope[WHOLE_STATE_COUNT];
  model_rhs_in_contact(point, phase, whole, contacts, slope);
  reduced_keep(slope, dx);
}

SHARED_FN void reduced_contact_tangent(const ModelPoint* point, const ModelLinear* linear,
                                       const real* w, ModelContact* added) {
  const real whole[WHOLE_STATE_COUNT] = WHOLE_STATE(w);
  model_contact_tangent(point, linear, whole, added);
}

SHARED_FN void reduced_force_direction(const ModelPoint* point, const PhaseAt* phase, const real* x,
                                       int contact, real* direction) {
  const real whole[WHOLE_STATE_COUNT] = WHOLE_STATE(x);
  real whole_direction[WHOLE_STATE_COUNT];
  model_force_direction(point, phase, whole, contact, whole_direction);
  reduced_keep(whole_direction, direction);
}

SHARED_FN void reduced_force_direction_carried(const ModelPoint* point, const PhaseAt* phase,
                                               const real* x, const real* direction, real* dx) {
  const real whole[WHOLE_STATE_COUNT] = WHOLE_STATE(x);
  const real whole_direction[WHOLE_STATE_COUNT] = WHOLE_STATE(direction);
  real slope[WHOLE_STATE_COUNT];
  model_force_direction_carried(point, phase, whole, whole_direction, slope);
  reduced_keep(slope, dx);
}

#ifdef MODEL_CONTACT_FEEDBACK
SHARED_FN void reduced_contact_along(const ModelPoint* point, const PhaseAt* phase, const real* x,
                                     const real* direction, ModelContact* added) {
  const real whole[WHOLE_STATE_COUNT] = WHOLE_STATE(x);
  const real whole_direction[WHOLE_STATE_COUNT] = WHOLE_STATE(direction);
  model_contact_along(point, phase, whole, whole_direction, added);
}
#define model_contact_along reduced_contact_along
#endif

#ifdef MODEL_FORCE_DIRECTION_VARIES
SHARED_FN void reduced_force_direction_tangent(const ModelPoint* point, const PhaseAt* phase,
                                               const real* x, int contact, const real* w,
                                               real* out) {
  const real whole[WHOLE_STATE_COUNT] = WHOLE_STATE(x);
  const real whole_w[WHOLE_STATE_COUNT] = WHOLE_STATE(w);
  real whole_out[WHOLE_STATE_COUNT];
  model_force_direction_tangent(point, phase, whole, contact, whole_w, whole_out);
  reduced_keep(whole_out, out);
}
#define model_force_direction_tangent reduced_force_direction_tangent
#endif

#define model_contact reduced_contact
#define model_rhs_in_contact reduced_rhs_in_contact
#define model_contact_tangent reduced_contact_tangent
#define model_force_direction reduced_force_direction
#define model_force_direction_carried reduced_force_direction_carried
#endif

#define MODEL_STATE_COUNT KEPT_COUNT
#define model_rhs reduced_rhs
#define model_linearize reduced_linearize
#define model_tangent reduced_tangent
#define model_signals reduced_signals
#define model_take_turns reduced_take_turns
