// The settle kernel's arithmetic on the host. Included into a namespace that has `real` and
// `scalar`; so no include guard and no includes of the standard library.
#include "gear5.h"
// The integrator needs the model, and the walk needs both.
#include "rk4/rk4.h"
#define TANGENTS 0
#include "tangent.h"
#include "unwatched.h"
#define STATE_LIMIT(name, unit, meaning) kDivergedAbove,
#define STATE_LIMITS \
  { MODEL_STATES(STATE_LIMIT) }
#include "walk.h"

// The state after `periods` periods, NaN in x[0] when it diverged.
inline std::vector<double> step_periods(const ModelSetting& setting, const PhaseGrid& grid,
                                        const std::vector<double>& start, std::size_t periods,
                                        bool events) {
  std::vector<real> values;
  for (const double value : setting.parameters) values.push_back(static_cast<real>(value));
  ModelParameters parameters;
  std::memcpy(&parameters, values.data(), sizeof parameters);
  ModelOptions options;
  std::memcpy(&options, setting.options.data(), sizeof options);
  ModelPoint point;
  model_prepare(&parameters, options, &point);

  const std::size_t width = sizeof(PhaseCoefs) / sizeof(scalar);
  std::vector<PhaseCoefs> stages(grid.coefs.size() / width);
  for (std::size_t i = 0; i < grid.coefs.size(); ++i) {
    const auto coef = static_cast<scalar>(grid.coefs[i]);
    std::memcpy(reinterpret_cast<char*>(stages.data()) + i * sizeof coef, &coef, sizeof coef);
  }
  real x[MODEL_STATE_COUNT];
  for (std::size_t i = 0; i < MODEL_STATE_COUNT; ++i) x[i] = static_cast<real>(start[i]);
  const std::vector<scalar> fractions(grid.segment_fractions.begin(), grid.segment_fractions.end());
  const WalkGrid walked = {static_cast<sweep_uint>(grid.segment_steps.size()),
                           grid.segment_steps.data(), fractions.data(), stages.data()};
  for (std::size_t period = 0; period < periods; ++period) {
    walk_period(&point, &walked, events, 0, x, nullptr, nullptr, nullptr, nullptr);
  }
  return std::vector<double>(x, x + MODEL_STATE_COUNT);
}
