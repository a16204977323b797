// The types that every model has, made from its lists. A model file defines MODEL_STATES,
// MODEL_PARAMETERS, MODEL_OPTIONS, MODEL_SIGNALS and MODEL_PHASE_COEFS, then includes this file, then
// defines its functions. No include guard: the host includes each model into a namespace of its own.

#define MODEL_COUNT_ONE(name, ...) +1
#define MODEL_DECLARE_REAL(name, ...) real name;
#define MODEL_DECLARE_SCALAR(name, ...) scalar name;
#define MODEL_DECLARE_INT(name, ...) int name;
#define MODEL_STATE_INDEX(name, ...) STATE_##name,

enum { MODEL_STATES(MODEL_STATE_INDEX) MODEL_STATE_COUNT };

typedef struct { MODEL_PARAMETERS(MODEL_DECLARE_REAL) } ModelParameters;
typedef struct { MODEL_OPTIONS(MODEL_DECLARE_INT) } ModelOptions;
typedef struct { MODEL_SIGNALS(MODEL_DECLARE_REAL) } ModelSignals;
typedef struct { MODEL_PHASE_COEFS(MODEL_DECLARE_SCALAR) } PhaseCoefs;
