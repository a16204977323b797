#include "flop_count.hpp"

#include <cstring>
#include <string>
#include <vector>

#include "counted.hpp"
#define REAL_BITS counted_bits
#include "dialect.h"

namespace gearsweep::bench {
namespace {

// Of the device's numbers that Counted stands for: some models need less work in fp32.
int counted_bits = 64;

using real = Counted;
using scalar = Counted;
#include "models/gear5.h"
//
#include "integrators/rk4.h"

// Three rows of coefficients that change with the phase. Any numbers do, as long as no two are
// alike.
std::vector<PhaseCoefs> generic_stages(Tally* tally) {
  std::vector<PhaseCoefs> stages(RK4_STAGES_PER_STEP + 1);
  double value = 0.3;
  const auto next = [&] { return Counted(value += 0.0137, tally); };
#define SET_COEF(name, meaning) coefs.name = next();
  for (PhaseCoefs& coefs : stages) {
    MODEL_PHASE_COEFS(SET_COEF)
  }
  return stages;
}

}  // namespace

double flops_per_step(const Study& study) {
  counted_bits = study.integrate.fp64 ? 64 : 32;
  ModelParameters parameters;
  std::size_t index = 0;
  // Parameters that share a default would look like one and the same.
  const auto next = [&] {
    const double value = study.setting.parameters[index];
    return Counted(value * (1.0 + 0.00173 * static_cast<double>(++index)));
  };
#define SET_PARAMETER(name, unit, value, least, greatest, shapes_phase, meaning) \
  parameters.name = next();
  MODEL_PARAMETERS(SET_PARAMETER)
  ModelOptions options;
  static_assert(sizeof options % sizeof(int) == 0);
  std::memcpy(&options, study.setting.options.data(), sizeof options);
  ModelPoint point;
  model_prepare(&parameters, options, &point);

  Tally tally;
  const std::vector<PhaseCoefs> stages = generic_stages(&tally);
  real x[MODEL_STATE_COUNT];
  for (int i = 0; i < MODEL_STATE_COUNT; ++i) x[i] = Counted(0.11 + 0.019 * i, &tally);
  x[STATE_x1] = Counted(3.1, &tally);  // in contact, so that the mesh force is not zero
  rk4_step(&point, stages.data(), 0.047, study.integrate.events, x);
  return tally.flops();
}

}  // namespace gearsweep::bench
