// A gear of which something is measured: the tables that its study holds, and what its mesh is.
#pragma once

#include <string>

#include "support/mesh.hpp"
#include "support/run.hpp"
#include "support/settings.hpp"

namespace gearsweep::testing {

inline constexpr double kMeanStiffness = 2.174e8;

inline const std::string kMeasuredDrawing =
    "[gear]\nteeth = [20, 30]\nmodule_mm = 3.0\npressure_angle_deg = 20.0\ncontact_ratio = 1.3\n"
    "inertia_kg_mm2 = 2230.0\nmass_kg = 1.0\n"
    "bearing_stiffness_N_per_mm = 3.0e5\nbearing_damping_N_s_per_mm = 1.4\n"
    "mesh_damping_N_s_per_mm = 0.7\nmesh_stiffness_N_per_m = 2.174e8\nhalf_backlash_mm = 0.05\n"
    "torque_N_m = 61.3\n";
inline const std::string kOneSine = "transmission_error_um = 30.0\n";
inline const std::string kMeasuredOmegas =
    "[[axes]]\nname = 'omega'\nvalues = [0.45, 0.7, 1.0]\n[integrate]\nsettle = 40\nrecord = 2\n"
    "steps_per_period = 512\nstop = 'never'\n[observe]\nquantities = ['dmf_max', 'poincare']\n"
    "poincare = ['x1', 'x3', 'v1', 'v4']\n";

inline std::string held_table(const std::string& name, const std::string& numbers) {
  return "[gear.tables]\n'" + name + "' = '''\n" + numbers + "'''\n";
}

inline std::string measured_text(const std::string& keys, const std::string& tables = "") {
  return kMeasuredDrawing + keys + tables + kMeasuredOmegas;
}

inline Study measured_study(const std::string& keys, const std::string& tables = "") {
  return read_study(measured_text(keys, tables), "test.toml");
}

inline Mesh mesh_of(const Study& study, double psi, double inside) {
  return mesh_at(*study.model, study.setting, psi, inside);
}
inline Mesh mesh_of(const Study& study, double psi) { return mesh_of(study, psi, psi); }

}  // namespace gearsweep::testing
