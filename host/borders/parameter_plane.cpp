#include "borders/parameter_plane.hpp"

namespace gearsweep {

ModelSetting ParameterPlane::setting_at(const PlanePlace& place) const {
  ModelSetting out = setting;
  for (std::size_t i = 0; i < 2; ++i) out.parameters[parameters[i]] = place[i];
  model->derive(&out);
  return out;
}

bool ParameterPlane::contains(const PlanePlace& place) const {
  for (std::size_t i = 0; i < 2; ++i) {
    if (!(place[i] >= from[i] && place[i] <= to[i])) return false;
  }
  return true;
}

bool ParameterPlane::is_allowed(const PlanePlace& place) const {
  for (std::size_t i = 0; i < 2; ++i) {
    const ParameterInfo& info = model->parameters[parameters[i]];
    if (!(place[i] >= info.min && place[i] <= info.max)) return false;
  }
  return model->check(setting_at(place)).empty();
}

}  // namespace gearsweep
