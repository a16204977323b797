#include <algorithm>
#include <memory>

#include "plan/phase_grid.hpp"
#include "report/detail/findings.hpp"

namespace gearsweep {

double static_jump(const Model& model, const ModelSetting& setting) {
  const ChannelInfo* force = model.contact_force();
  if (force == nullptr) return 1.0;
  const auto signal = static_cast<std::size_t>(model.find_signal(force->name));
  const std::vector<double> state = model.equilibrium(setting);
  const std::unique_ptr<PreparedPoint> point = model.prepare(setting);
  const std::vector<double> bounds = segment_bounds(model, setting);
  std::vector<double> coefs(model.phase_coefs.size()), signals(model.signals.size());
  const auto force_at = [&](double phase, std::size_t segment) {
    const double inside = 0.5 * (bounds[segment] + bounds[segment + 1]);
    model.phase_coefs_at(setting, phase, inside, coefs.data());
    point->signals(coefs.data(), state.data(), signals.data());
    return signals[signal];
  };
  const std::size_t segments = bounds.size() - 1;
  double largest = 1.0;
  for (std::size_t segment = 0; segment < segments; ++segment) {
    const std::size_t last = (segment + segments - 1) % segments;
    const double before = force_at(bounds[last + 1], last);
    const double after = force_at(bounds[segment], segment);
    if (before > 0.0) largest = std::max(largest, after / before);
  }
  return largest;
}

}  // namespace gearsweep
