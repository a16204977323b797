// Materials of components.
#pragma once

#include <optional>

#include "rexs/detail/lookup.hpp"

namespace gearsweep {

struct RexsMaterial {
  std::optional<double> density;                  // kg/dm^3
  std::optional<double> modulus, shear, poisson;  // N/mm^2, N/mm^2, 1
};

// What the materials that a component refers to give, each number by the first that has it.
RexsMaterial material_of(const RexsComponent& component, RexsLookup* lookup);

}  // namespace gearsweep
