#include "verify/detail/host_stepper.hpp"

#include <cmath>
#include <cstdint>
#include <cstring>

#include "dialect.h"
#include "sweep_types.h"
#include "verify/whole_kernel.hpp"

namespace gearsweep {
namespace {

constexpr double kDivergedAbove = 1e6;  // of gear5

}  // namespace

namespace fp64 {
using std::fabs;
using std::log;
using std::sqrt;
using real = double;
using scalar = double;
#include "verify/detail/shared_stepper.h"
}  // namespace fp64

namespace fp32 {
using std::fabs;  // the ones for float too
using std::log;
using std::sqrt;
using real = float;
using scalar = float;
#include "verify/detail/shared_stepper.h"
}  // namespace fp32

Study with_whole_kernel(Study study) {
  study.model = &whole_kernel_model();
  study.own_model = nullptr;
  return study;
}

std::vector<double> step_on_host(const Plan& plan, std::size_t point, std::size_t periods) {
  const Integrate& integrate = plan.study().integrate;
  const auto step = integrate.fp64 ? fp64::step_periods : fp32::step_periods;
  return step(plan.setting_of(point), plan.phase_grid_of(point), plan.own_initial_state(point),
              periods, integrate.events);
}

}  // namespace gearsweep
