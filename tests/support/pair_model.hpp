// gear1 with harmonic stiffness, as a text of equations.
#pragma once

#include <string>

namespace gearsweep::testing {

inline std::string pair_model() {
  return "[model]\n"
         "name = \"pair\"\n"
         "summary = \"gear pair\"\n"
         "[states]\n"
         "x = { unit = \"b_n\", meaning = \"deflection\", start = \"b + Fm\" }\n"
         "v = { unit = \"b_n varpi\", meaning = \"velocity\" }\n"
         "[parameters]\n"
         "omega = { value = 0.8, min = 1e-4, max = 100 }\n"
         "b = { value = 1.0, min = 0 }\n"
         "z = 0.05\n"
         "Fm = { value = 0.1, role = \"load\" }\n"
         "Fte = 0.01\n"
         "Fte_2 = 0.004\n"
         "Fte_3 = 0.002\n"
         "k = 0.2\n"
         "k_2 = 0.1\n"
         "k_3 = 0.05\n"
         "[constants]\n"
         "stiffness = \"1 - k*cos(phase) - k_2*cos(2*phase) - k_3*cos(3*phase)\"\n"
         "f = \"backlash(x, b)\"\n"
         "drive = \"Fte*cos(phase) + 4*Fte_2*cos(2*phase) + 9*Fte_3*cos(3*phase)\"\n"
         "[equations]\n"
         "x = \"v\"\n"
         "v = \"Fm + omega^2*drive - 2*z*v - stiffness*f\"\n"
         "[forcing]\n"
         "period = \"2*pi/omega\"\n"
         "[signals]\n"
         "dmf = { expression = \"stiffness*f\", unit = \"k0 b_n\", meaning = \"force\", "
         "role = \"mesh_force\" }\n";
}

}  // namespace gearsweep::testing
