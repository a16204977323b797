#include "model/role.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace gearsweep {
namespace {

constexpr std::array<std::pair<Role, const char*>, 8> kRoleNames = {
    {{Role::load, "load"},
     {Role::mesh_damping, "mesh_damping"},
     {Role::pinion_teeth, "pinion_teeth"},
     {Role::teeth_ratio, "teeth_ratio"},
     {Role::mesh_order, "mesh_order"},
     {Role::mesh_force, "mesh_force"},
     {Role::transmission_error, "transmission_error"},
     {Role::bearing_force, "bearing_force"}}};

}  // namespace

std::string name_of(Role role) {
  const auto found = std::ranges::find(kRoleNames, role, &std::pair<Role, const char*>::first);
  return found == kRoleNames.end() ? "" : found->second;
}

Role role_of(std::string_view name) {
  const auto found = std::ranges::find(kRoleNames, name, &std::pair<Role, const char*>::second);
  return found == kRoleNames.end() ? Role::none : found->first;
}

const std::vector<Role>& roles_of_parameters() {
  static const std::vector<Role> kRoles = {Role::load, Role::mesh_damping, Role::pinion_teeth,
                                           Role::teeth_ratio, Role::mesh_order};
  return kRoles;
}

const std::vector<Role>& roles_of_signals() {
  static const std::vector<Role> kRoles = {Role::mesh_force, Role::transmission_error,
                                           Role::bearing_force};
  return kRoles;
}

}  // namespace gearsweep
