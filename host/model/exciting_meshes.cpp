#include "model/exciting_meshes.hpp"

#include <optional>

namespace gearsweep {

std::vector<ExcitingMesh> exciting_meshes(const Model& model, const ModelSetting& setting) {
  const std::optional<std::size_t> other = model.parameter_of(Role::mesh_order);
  if (!other) return {{}};
  const std::string& name = model.parameters[*other].name;
  return {{model.unit_drawing, 1.0},
          {name.substr(name.rfind('_') + 1), setting.parameters[*other]}};
}

}  // namespace gearsweep
