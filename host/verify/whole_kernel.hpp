// gear5 with a kernel that holds for all its options and parameters, where a study's own is made
// for the study: what the host's compiler reads.
#pragma once

#include <string>

#include "study/builtin_models.hpp"

namespace gearsweep {

inline const Model& whole_kernel_model() {
  static const Model kModel = [] {
    const Model& gear5 = *find_model("gear5");
    Binding binding;
    // What the others change is tabulated on the host.
    binding.parameters = {"omega", "b",  "mu", "F1", "e0", "zeta", "m1", "m2", "k1",
                          "k2",    "k3", "k4", "c1", "c2", "c3",   "c4", "A"};
    return gear5.bound(binding);
  }();
  return kModel;
}

}  // namespace gearsweep
