#include <fmt/format.h>

#include <array>
#include <string>

#include "verify/detail/check_list.hpp"

namespace gearsweep {
namespace {

// A trajectory that passes near a stable orbit and goes elsewhere, and the largest meshing force of
// its own motion, from an independent integrator (Dormand-Prince 8, restarts at break phases,
// located contact events). Named by what the orbit near by would have.
struct PassingPoint {
  const char *name, *study;
  double force;
};

constexpr std::array<PassingPoint, 3> kPoints = {{
    {"quasi-periodic, not 0.0822",
     "[model]\npreset = 'consistent'\n[parameters]\nzeta = 0.02\nF1 = 0.04\ne0 = 0.0541732\n"
     "[[axes]]\nname = 'omega'\nvalues = [0.540945]\n",
     0.1465},
    {"period 1, not 0.6719",
     "[model]\npreset = 'coarse'\n[parameters]\nb = 5.0\n"
     "[[axes]]\nname = 'omega'\nvalues = [0.455]\n",
     0.7142},
    {"impacts of period 2, not 0.1706",
     "[model]\nname = 'gear1'\npreset = 'spur'\n[parameters]\nz = 0.02\nFte = 0.05\nk = 0.094488\n"
     "[[axes]]\nname = 'omega'\nvalues = [1.96063]\n",
     0.3338},
}};

}  // namespace

// The forces are given to four digits, 5e-5; the other half is for what a driver rounds.
std::vector<Compared> compare_stopped_points(const Subject& subject) {
  std::vector<Compared> compared;
  for (const PassingPoint& point : kPoints) {
    const SweepResult result = subject.compute(
        read_study(std::string(point.study) +
                       "[integrate]\nsettle = 2500\n[observe]\nquantities = ['dmf_max']\n",
                   "verify"));
    compared.push_back({fmt::format("largest force ({})", point.name), point.force,
                        map_of(result, "dmf_max").front(), 1e-4});
  }
  return compared;
}

}  // namespace gearsweep
