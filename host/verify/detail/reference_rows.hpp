// Steady motions of gear5 that two or more independent programs agree on (steps converged), from
// the model's description, section "Reference numbers". Section = state at psi = 0 after `settle`
// periods; the other figures are over the `record` periods that follow.
//
// That table's smallest, largest, mean and rms of x1 are averages and extremes of samples, off by
// up to 3.1e-5 and 5.2e-6. The ones here are from an outside integration (Boost.odeint's
// Dormand-Prince at 1e-12, the integrals of x1 and x1^2 as two more states, extremes between the
// steps too), which outside_opinion_test.cpp repeats. So is all of the row with a wedged tooth,
// which that table has not.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "engine/result.hpp"
#include "verify/compared.hpp"

namespace gearsweep {

struct ReferenceRow {
  std::string name, preset;
  std::string model;  // what [model] says beside the preset
  double omega;
  std::string parameters;  // what [parameters] says
  std::size_t settle, record;
  double x1, v1;
  double min, max;   // of x1
  double mean, rms;  // of x1
  double dmf_min, dmf_max;
};

const std::vector<ReferenceRow>& reference_rows();

// The row of that name. Throws std::logic_error when there is none.
const ReferenceRow& reference_row(const std::string& name);

// The row as a study of one point; `integrate` is put into [integrate].
std::string study_of(const ReferenceRow& row, const std::string& integrate);

// For [integrate]: the steps per period at which the motions are converged in fp64.
std::string converged_steps(const ReferenceRow& row);

// The figures of study_of(row, ...), computed in fp64 with converged_steps() or in fp32 with at
// least 512 steps per period, beside the row's.
std::vector<Compared> compare_row(const ReferenceRow& row, const SweepResult& result);

}  // namespace gearsweep
