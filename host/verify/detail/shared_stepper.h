// The settle kernel's arithmetic on the host. Included into a namespace that has `real` and
// `scalar`; so no include guard and no includes of the standard library.
#include "models/gear5.h"
// The integrator needs the model.
#include "integrators/rk4.h"

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
  for (std::size_t period = 0; period < periods; ++period) {
    const PhaseCoefs* stage = stages.data();
    for (std::size_t segment = 0; segment < grid.segment_steps.size(); ++segment) {
      const real h = static_cast<scalar>(grid.segment_fractions[segment]) * point.period;
      for (std::uint32_t step = 0; step < grid.segment_steps[segment]; ++step) {
        rk4_step(&point, stage, h, events, x);
        stage += RK4_STAGES_PER_STEP;
      }
      stage += 1;
    }
  }
  return std::vector<double>(x, x + MODEL_STATE_COUNT);
}
