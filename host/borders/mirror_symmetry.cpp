#include "borders/mirror_symmetry.hpp"

#include <array>
#include <cmath>
#include <memory>
#include <vector>

namespace gearsweep {
namespace {

constexpr double kSameField = 1e-9;                          // of the field's largest component
constexpr std::array<double, 3> kReaches = {0.1, 1.0, 5.0};  // of states
constexpr int kPlaces = 7;

// The field of the whole model at a state and a phase, on the side of the phase that is behind it.
std::vector<double> field_at(const Model& model, const ModelSetting& setting,
                             const PreparedPoint& point, const std::vector<double>& state,
                             double phase) {
  std::vector<double> row(model.phase_coefs.size()), out(model.states.size());
  model.phase_coefs_at(setting, phase, phase + 1e-7, row.data());
  point.rhs(row.data(), state.data(), out.data());
  return out;
}

bool is_mirrored_at(const Model& kept, const ModelSetting& setting) {
  const Model& model = kept.full();
  const std::unique_ptr<PreparedPoint> point = model.prepare(setting);
  std::vector<std::size_t> looked_at = kept.reduction.kept;
  if (kept.whole == nullptr) {
    for (std::size_t i = 0; i < model.states.size(); ++i) looked_at.push_back(i);
  }
  int number = 0;
  for (const double reach : kReaches) {
    for (int place = 0; place < kPlaces; ++place) {
      std::vector<double> state(model.states.size()), mirrored(model.states.size());
      for (const std::size_t i : looked_at) state[i] = reach * std::sin(1.7 * ++number);
      for (const MirrorPairs::Pair& pair : kept.reduction.mirrors) {
        state[pair.second] = -state[pair.first];
      }
      for (std::size_t i = 0; i < state.size(); ++i) mirrored[i] = -state[i];
      const double phase = (place + 0.37) / (2.0 * kPlaces);
      const std::vector<double> here = field_at(model, setting, *point, state, phase);
      const std::vector<double> there = field_at(model, setting, *point, mirrored, phase + 0.5);
      double size = 0.0, off = 0.0;
      for (const std::size_t i : looked_at) {
        size = std::max(size, std::fabs(here[i]));
        off = std::max(off, std::fabs(here[i] + there[i]));
      }
      if (!(off <= kSameField * size)) return false;
    }
  }
  return true;
}

}  // namespace

bool is_mirrored(const ParameterPlane& plane) {
  const Model& model = *plane.model;
  if (!model.full().surfaces.empty() || model.clocks > 0) return false;
  for (const double share : {0.25, 0.75}) {
    PlanePlace place{};
    for (std::size_t i = 0; i < 2; ++i) place[i] = plane.from[i] + share * plane.range(i);
    if (!plane.is_allowed(place) || !is_mirrored_at(model, plane.setting_at(place))) return false;
  }
  return true;
}

}  // namespace gearsweep
