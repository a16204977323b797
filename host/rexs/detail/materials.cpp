#include "rexs/detail/materials.hpp"

#include <string_view>

namespace gearsweep {

RexsMaterial material_of(const RexsComponent& component, RexsLookup* lookup) {
  RexsMaterial found;
  for (const RexsComponent* one : lookup->related(component, "reference", "origin", "referenced")) {
    if (one->type != "material") continue;
    const auto take = [&](std::string_view name, RexsQuantity quantity,
                          std::optional<double>* into) {
      const auto number = lookup->number(*one, name, quantity);
      if (number && *number > 0.0 && !*into) *into = number;
    };
    take("density", RexsQuantity::density, &found.density);
    take("elastic_modulus", RexsQuantity::pressure, &found.modulus);
    take("shear_modulus", RexsQuantity::pressure, &found.shear);
    take("poisson_ratio", RexsQuantity::number, &found.poisson);
  }
  if (!found.shear && found.modulus && found.poisson) {
    found.shear = *found.modulus / (2.0 * (1.0 + *found.poisson));
  }
  return found;
}

}  // namespace gearsweep
