// Counts a step of gear5. Included into a namespace that has `real` and `scalar`, numbers that
// count; so no include guard and no includes of the standard library.
#include "models/gear5.h"
// The integrator needs the model.
#include "rk4/rk4.h"

// Three rows of coefficients that change with the phase. Any numbers do, as long as no two are
// alike.
inline std::vector<PhaseCoefs> generic_stages(Tally* tally) {
  std::vector<PhaseCoefs> stages(RK4_STAGES_PER_STEP + 1);
  double value = 0.3;
  const auto next = [&] { return scalar(value += 0.0137, tally); };
#define SET_COEF(name, meaning) coefs.name = next();
  for (PhaseCoefs& coefs : stages) {
    MODEL_PHASE_COEFS(SET_COEF)
  }
#undef SET_COEF
  return stages;
}

inline ModelPoint generic_point(const ModelSetting& setting) {
  ModelParameters parameters;
  std::size_t index = 0;
  // Parameters that share a default would look like one and the same.
  const auto next = [&] {
    const double value = setting.parameters[index];
    return real(value * (1.0 + 0.00173 * static_cast<double>(++index)));
  };
#define SET_PARAMETER(name, unit, value, min, max, shapes_phase, meaning) parameters.name = next();
  MODEL_PARAMETERS(SET_PARAMETER)
#undef SET_PARAMETER
  ModelOptions options;
  static_assert(sizeof options % sizeof(int) == 0);
  std::memcpy(&options, setting.options.data(), sizeof options);
  ModelPoint point;
  model_prepare(&parameters, options, &point);
  return point;
}

inline double count_step(const ModelSetting& setting, bool events, std::size_t tangents) {
  const ModelPoint point = generic_point(setting);
  Tally tally;
  const std::vector<PhaseCoefs> stages = generic_stages(&tally);
  const real h = 0.047;
  double value = 0.11;
  const auto next = [&] { return real(value += 0.019, &tally); };
  real x[MODEL_STATE_COUNT];
  for (real& number : x) number = next();
  x[STATE_x1] = real(3.1, &tally);  // in contact, so that the mesh force is not zero
  ModelLinear linear[RK4_EVALUATIONS];
  Crossings crossings;
  const int beside = (events ? RK4_CORRECTED : 0) | (tangents > 0 ? RK4_LINEAR : 0);
  rk4_step_linearized(&point, stages.data(), h, beside, x, nullptr, linear, &crossings);
  for (std::size_t j = 0; j < tangents; ++j) {
    real w[MODEL_STATE_COUNT];
    for (real& number : w) number = next();
    rk4_tangent_step(&point, h, beside, linear, &crossings, w);
  }
  return tally.flops();
}
