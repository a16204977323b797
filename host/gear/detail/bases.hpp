// What the equations of motion are scaled by.
#pragma once

#include "gear/detail/bodies.hpp"
#include "gear/detail/geometry.hpp"
#include "gear/detail/target.hpp"

namespace gearsweep {

// SI units.
struct GearBases {
  double pinion_mesh_mass, gear_mesh_mass;  // I/R^2, kg
  double me;                                // kg
  double k0;                                // N/m, the unit of stiffness
  double stiffness_factor;                  // the mean mesh stiffness over k0
  double b_n;                               // m, the unit of length
  double half_backlash;                     // m
  double varpi;                             // rad/s
  double pinion_base;                       // Rp, m
};

// measured_stiffness: the mean of it; 0 where there is none. Throws DrawingError.
GearBases bases_of(const GearDrawing& drawing, const GearGeometry& geometry,
                   const GearBodies& bodies, double contact_ratio, double measured_stiffness,
                   GearTarget* target);

}  // namespace gearsweep
