#include "verify/detail/reference_rows.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace gearsweep {
namespace {

// The recorded section that is nearest to the stated one, which for a motion of period 3 is one of
// three.
std::size_t nearest_section(const ReferenceRow& row, const std::vector<double>& x1,
                            const std::vector<double>& v1) {
  const auto distance = [&](std::size_t i) {
    return std::max(std::abs(x1[i] - row.x1), std::abs(v1[i] - row.v1));
  };
  std::size_t nearest = 0;
  for (std::size_t i = 1; i < x1.size(); ++i) {
    if (distance(i) < distance(nearest)) nearest = i;
  }
  return nearest;
}

// By how much the figures may differ.
struct Tolerances {
  double section, min, max, mean, rms, force, fractions;
};

Tolerances tolerances_of(const ReferenceRow& row, bool fp64) {
  // fp32 has a unit roundoff of 6e-8, and the damping forgets the rounding of all but some 1e4
  // steps: even if it all added up, that would be 6e-4 of a state of size 1. `paper` forgets too
  // little.
  if (!fp64) return {1e-3, 1e-3, 1e-3 * row.max, 1e-3 * row.mean, 1e-3 * row.rms, 1e-3, 1e-5};
  Tolerances tolerances{};
  // Half of the seventh decimal that is stated, and 5e-9 for the steps and what is left of the
  // start.
  tolerances.section = 5e-8 + 5e-9;
  // Half of the fifth decimal; sampling adds (h/2)^2/2 |x1''|, which is less than 2e-6.
  tolerances.min = tolerances.max = 5e-6;
  // Half of the sixth decimal; the trapezoidal rule adds 1e-8.
  tolerances.mean = tolerances.rms = 5e-7;
  // The table's own tolerance: the force jumps at break phases.
  tolerances.force = 3e-4;
  // Rounding in the sum of some thousand steps.
  tolerances.fractions = 1e-12;
  return tolerances;
}

}  // namespace

// The damping of `consistent` and `coarse` makes 200 periods steady to 1e-9 and better; `paper` has
// a sixteenth of it and needs thousands.
const std::vector<ReferenceRow>& reference_rows() {
  const std::string dynamic = "backlash = 'dynamic'";
  const std::string rectangular = "stiffness = 'rectangular'";
  // The motion at omega 1.2 has period 3: its averages are over 21 periods here, over 20 in the
  // table.
  static const std::vector<ReferenceRow> kRows = {
      {"consistent_025", "consistent", "", 0.25, "", 200, 1, 1.4347167, 0.0115000, 1.0794531,
       1.4352721, 1.24779165, 1.25222250, 0.0342, 0.2181},
      {"consistent_05", "consistent", "", 0.5, "", 200, 1, 0.7177006, -0.2098154, 0.5560548,
       1.7309603, 1.17068647, 1.24513416, 0.0, 0.3731},
      {"consistent_05_dynamic", "consistent", dynamic, 0.5, "", 200, 1, 0.8245279, -0.2518006,
       0.5922119, 1.7521704, 1.21178205, 1.28490087, 0.0, 0.3169},
      {"consistent_07", "consistent", "", 0.7, "", 200, 1, 1.2601603, -0.1216647, 1.0166580,
       1.4109815, 1.24636460, 1.25408854, 0.0258, 0.1930},
      {"consistent_07_b04", "consistent", "", 0.7, "b = 0.4", 200, 1, 0.6601603, -0.1216647,
       0.4166580, 0.8109815, 0.64636460, 0.66113580, 0.0258, 0.1930},
      {"consistent_07_dynamic", "consistent", dynamic, 0.7, "", 200, 1, 1.2829344, -0.1286432,
       1.0347553, 1.4310818, 1.26562439, 1.27323051, 0.0204, 0.2041},
      {"consistent_07_mu0", "consistent", "", 0.7, "mu = 0.0", 200, 1, 1.2589690, -0.1204830,
       1.0166181, 1.4118258, 1.24660426, 1.25435117, 0.0257, 0.1926},
      {"consistent_07_mu01_dynamic", "consistent", dynamic, 0.7, "mu = 0.1", 200, 1, 1.2851064,
       -0.1284288, 1.0346572, 1.4296757, 1.26501696, 1.27258004, 0.0211, 0.2063},
      {"consistent_07_rectangular", "consistent", rectangular, 0.7, "", 200, 1, 1.2724047,
       -0.1114043, 1.0030928, 1.4012428, 1.24637625, 1.25428012, 0.0, 0.2402},
      {"consistent_10", "consistent", "", 1.0, "", 200, 1, 0.8760150, -0.1471573, 0.8048304,
       1.2807164, 1.03462563, 1.04787153, 0.0, 0.4214},
      {"consistent_12", "consistent", "", 1.2, "", 402, 21, 1.5159069, -0.2230728, 0.0373538,
       1.8026813, 0.93126707, 1.08937479, 0.0, 0.5257},
      {"coarse_065", "coarse", "", 0.65, "", 200, 1, 1.1926480, -0.4649288, 0.4734794, 1.9178619,
       1.24013479, 1.34256528, 0.0, 0.2320},
      {"coarse_08", "coarse", "", 0.8, "", 200, 1, 1.1771956, -0.3326357, 0.8157385, 1.6591264,
       1.23174244, 1.26735977, 0.0, 0.2311},
      {"coarse_10", "coarse", "", 1.0, "", 200, 1, 0.4534132, -0.5925484, 0.0123757, 1.3936967,
       0.68091256, 0.83592840, 0.0, 0.5438},
      {"coarse_05_wedged", "coarse", dynamic, 0.5021, "b = 0.2553", 200, 1, -3.32679666,
       -1.45632775, -4.0055466, 5.0229529, 0.52751002, 3.09642080, -1.5539, 1.5561},
      {"paper_01_mu0", "paper", "", 0.1, "mu = 0.0", 4000, 1, 0.9325949, -0.0003915, 0.9312126,
       0.9442505, 0.93765123, 0.93766255, 0.1722, 0.1745},
      {"paper_01_mu01", "paper", "", 0.1, "mu = 0.1", 4000, 1, 0.9332535, -0.0037283, 0.9183756,
       0.9547393, 0.93729652, 0.93733072, 0.1669, 0.1806},
      {"paper_05", "paper", "", 0.5, "b = 0.39", 9000, 1, 0.3181070, 0.0316079, 0.2648087,
       0.3873325, 0.32709367, 0.32989950, 0.1266, 0.2189},
      {"paper_05_dynamic", "paper", dynamic, 0.5, "b = 0.39", 9000, 1, 0.3482548, 0.0298512,
       0.2971653, 0.4127611, 0.35658540, 0.35887730, 0.1269, 0.2175},
  };
  return kRows;
}

const ReferenceRow& reference_row(const std::string& name) {
  const std::vector<ReferenceRow>& rows = reference_rows();
  const auto found = std::find_if(rows.begin(), rows.end(),
                                  [&](const ReferenceRow& row) { return row.name == name; });
  if (found == rows.end()) throw std::logic_error("there is no reference row " + name);
  return *found;
}

std::string study_of(const ReferenceRow& row, const std::string& integrate) {
  return "[model]\npreset = '" + row.preset + "'\n" + row.model + "\n[parameters]\n" +
         row.parameters + "\n[[axes]]\nname = 'omega'\nvalues = [" + std::to_string(row.omega) +
         "]\n[integrate]\nsettle = " + std::to_string(row.settle) +
         "\nrecord = " + std::to_string(row.record) + "\n" + integrate +
         "\n[observe]\nquantities = ['x1_min', 'x1_max', 'x1_mean', 'x1_rms', 'dmf_min', "
         "'dmf_max', 'contact_drive', 'contact_gap', 'contact_back', 'contact_wedged', "
         "'poincare']\npoincare = ['x1', 'v1']\n";
}

// The rows of `paper` take thousands of periods, and their shorter ones need fewer steps.
std::string converged_steps(const ReferenceRow& row) {
  const bool takes_few = row.preset == "paper" && row.omega >= 0.2;
  return takes_few ? "steps_per_period = 512\n" : "steps_per_period = 1024\n";
}

std::vector<Compared> compare_row(const ReferenceRow& row, const SweepResult& result) {
  const Tolerances tolerances = tolerances_of(row, result.study.integrate.fp64);
  const std::vector<double> x1 = samples_of(result, 0, 0);
  const std::vector<double> v1 = samples_of(result, 0, 1);
  const std::size_t section = nearest_section(row, x1, v1);
  const auto value = [&](const char* quantity) { return map_of(result, quantity)[0]; };
  const auto name = [&](const std::string& figure) { return figure + " of " + row.name; };
  const double fractions = value("contact_drive") + value("contact_gap") + value("contact_back") +
                           value("contact_wedged");
  return {
      {name("x1 at phase 0"), row.x1, x1[section], tolerances.section},
      {name("v1 at phase 0"), row.v1, v1[section], tolerances.section},
      {name("x1_min"), row.min, value("x1_min"), tolerances.min},
      {name("x1_max"), row.max, value("x1_max"), tolerances.max},
      {name("x1_mean"), row.mean, value("x1_mean"), tolerances.mean},
      {name("x1_rms"), row.rms, value("x1_rms"), tolerances.rms},
      {name("dmf_min"), row.dmf_min, value("dmf_min"), tolerances.force},
      {name("dmf_max"), row.dmf_max, value("dmf_max"), tolerances.force},
      {name("sum of the fractions of contact"), 1.0, fractions, tolerances.fractions},
  };
}

}  // namespace gearsweep
