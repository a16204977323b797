// Steady motions of gear5 that two or more independent programs agree on (steps converged), from the
// model's description, section "Reference numbers". Section = state at psi = 0 after `settle`
// periods; the other figures are over the `record` periods that follow.
//
// Mean and rms are not those of that table, which are off by up to 5e-6 in the sixth decimal; they
// are from an outside integration (Boost.odeint's Dormand-Prince at 1e-12, with the integrals of x1
// and x1^2 as two more states), which outside_opinion_test.cpp repeats.
#pragma once

#include <cstddef>
#include <ostream>
#include <string>
#include <vector>

#include "study/study.hpp"

namespace gearsweep::testing {

struct ReferenceRow {
  std::string name, preset;
  std::string model;       // what [model] says beside the preset
  double omega;
  std::string parameters;  // what [parameters] says
  std::size_t settle, record;
  double x1, v1;
  double least, greatest;  // of x1
  double mean, rms;        // of x1
  double dmf_least, dmf_greatest;
};

inline void PrintTo(const ReferenceRow& row, std::ostream* out) { *out << row.name; }

// Free motion decays by a factor of at least 40 in ten periods of `consistent` and `coarse`, so 200
// periods are steady to the last bit; `paper` has 1/16 of their damping and needs thousands.
inline const std::vector<ReferenceRow>& reference_rows() {
  const std::string dynamic = "backlash = 'dynamic'";
  const std::string rectangular = "stiffness = 'rectangular'";
  // The motion at omega 1.2 has period 3. Table and this file give averages over 20 periods, which
  // is no multiple of 3, from the period on whose mean is the greatest.
  static const std::vector<ReferenceRow> rows = {
      {"consistent_025", "consistent", "", 0.25, "", 200, 1,
       1.4347167, 0.0115000, 1.07946, 1.43527, 1.24779165, 1.25222250, 0.0342, 0.2181},
      {"consistent_05", "consistent", "", 0.5, "", 200, 1,
       0.7177006, -0.2098154, 0.55607, 1.73096, 1.17068647, 1.24513416, 0.0, 0.3731},
      {"consistent_05_dynamic", "consistent", dynamic, 0.5, "", 200, 1,
       0.8245279, -0.2518006, 0.59221, 1.75217, 1.21178205, 1.28490087, 0.0, 0.3169},
      {"consistent_07", "consistent", "", 0.7, "", 200, 1,
       1.2601603, -0.1216647, 1.01667, 1.41098, 1.24636460, 1.25408854, 0.0258, 0.1930},
      {"consistent_07_b04", "consistent", "", 0.7, "b = 0.4", 200, 1,
       0.6601603, -0.1216647, 0.41667, 0.81098, 0.64636460, 0.66113580, 0.0258, 0.1930},
      {"consistent_07_dynamic", "consistent", dynamic, 0.7, "", 200, 1,
       1.2829344, -0.1286432, 1.03476, 1.43108, 1.26562439, 1.27323051, 0.0204, 0.2041},
      {"consistent_07_mu0", "consistent", "", 0.7, "mu = 0.0", 200, 1,
       1.2589690, -0.1204830, 1.01663, 1.41183, 1.24660426, 1.25435117, 0.0257, 0.1926},
      {"consistent_07_mu01_dynamic", "consistent", dynamic, 0.7, "mu = 0.1", 200, 1,
       1.2851064, -0.1284288, 1.03467, 1.42968, 1.26501696, 1.27258004, 0.0211, 0.2063},
      {"consistent_07_rectangular", "consistent", rectangular, 0.7, "", 200, 1,
       1.2724047, -0.1114043, 1.00310, 1.40124, 1.24637625, 1.25428012, 0.0, 0.2402},
      {"consistent_10", "consistent", "", 1.0, "", 200, 1,
       0.8760150, -0.1471573, 0.80484, 1.28071, 1.03462563, 1.04787153, 0.0, 0.4214},
      {"consistent_12", "consistent", "", 1.2, "", 402, 20,
       1.5159069, -0.2230728, 0.03735, 1.80268, 0.96295807, 1.11351773, 0.0, 0.5257},
      {"coarse_065", "coarse", "", 0.65, "", 200, 1,
       1.1926480, -0.4649288, 0.47351, 1.91786, 1.24013479, 1.34256528, 0.0, 0.2320},
      {"coarse_08", "coarse", "", 0.8, "", 200, 1,
       1.1771956, -0.3326357, 0.81576, 1.65913, 1.23174244, 1.26735977, 0.0, 0.2311},
      {"coarse_10", "coarse", "", 1.0, "", 200, 1,
       0.4534132, -0.5925484, 0.01239, 1.39370, 0.68091256, 0.83592840, 0.0, 0.5438},
      {"paper_01_mu0", "paper", "", 0.1, "mu = 0.0", 4000, 1,
       0.9325949, -0.0003915, 0.93121, 0.94425, 0.93765123, 0.93766255, 0.1722, 0.1745},
      {"paper_01_mu01", "paper", "", 0.1, "mu = 0.1", 4000, 1,
       0.9332535, -0.0037283, 0.91839, 0.95472, 0.93729652, 0.93733072, 0.1669, 0.1806},
      {"paper_05", "paper", "", 0.5, "b = 0.39", 9000, 1,
       0.3181070, 0.0316079, 0.26481, 0.38733, 0.32709367, 0.32989950, 0.1266, 0.2189},
      {"paper_05_dynamic", "paper", dynamic, 0.5, "b = 0.39", 9000, 1,
       0.3482548, 0.0298512, 0.29717, 0.41276, 0.35658540, 0.35887730, 0.1269, 0.2175},
  };
  return rows;
}

// The row as a study of one point; `integrate` is put into [integrate].
inline std::string study_of(const ReferenceRow& row, const std::string& integrate) {
  return "[model]\npreset = '" + row.preset + "'\n" + row.model + "\n[parameters]\n" +
         row.parameters + "\n[[axes]]\nname = 'omega'\nvalues = [" + std::to_string(row.omega) +
         "]\n[integrate]\nsettle = " + std::to_string(row.settle) +
         "\nrecord = " + std::to_string(row.record) + "\n" + integrate +
         "\n[observe]\nquantities = ['x1_min', 'x1_max', 'x1_mean', 'x1_rms', 'dmf_min', "
         "'dmf_max', 'poincare']\npoincare = ['x1', 'v1']\n";
}

}  // namespace gearsweep::testing
