// What a parameter or a signal is to the tool. A model says it; no code knows a name.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace gearsweep {

enum class Role {
  none,
  // Roles of parameters.
  load,          // each force between the teeth where nothing moves
  mesh_damping,  // damping ratio cm/(2 varpi me) of the mesh, from which the unit cm follows
  pinion_teeth,
  teeth_ratio,  // teeth of the gear over those of the pinion
  mesh_order,   // frequency of the mesh whose drawing its name ends in, over that of the phase
  // Roles of signals.
  mesh_force,  // a force between teeth; a train of gears has several
  transmission_error,
  bearing_force,
};

// As files have it; empty of none.
std::string name_of(Role role);
// Role::none of another text.
Role role_of(std::string_view name);

// The roles that a model's file of equations may give.
const std::vector<Role>& roles_of_parameters();
const std::vector<Role>& roles_of_signals();

}  // namespace gearsweep
