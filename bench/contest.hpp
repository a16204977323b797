// A kernel beside its rivals. The machine's speed drifts, so each iteration measures all of them in
// turn, and the counters are medians over the iterations:
//
//   steps/s          integration steps of single points per second, rounds after the first only
//   flops_per_step   counted on the kernel's source (measure/flop_count.hpp), without observables
//   flop/s           steps/s x flops_per_step
//   peak_flop/s      of the FMA micro-kernel on the same device, mean of before and after
//   peak_share       of the two
//   one_lane_steps/s, vs_one_lane   the same kernel with one point per work-item, and steps/s /
//   that times_states     steps/s of recording states alone / steps/s: what tangent vectors cost
//   odeint_steps/s, vs_odeint       Boost.odeint's runge_kutta4: native, all cores, -O3
//                                   -march=native, same precision
//   classic_...      the same with its runge_kutta4_classic
//   odeint_simd_..., classic_simd_...  both with a SIMD type for numbers
#pragma once

#include <benchmark/benchmark.h>

#include <memory>
#include <string>
#include <vector>

#include "measure/kernel_run.hpp"
#include "odeint_sweep.hpp"
#include "opencl/fma_peak.hpp"

namespace gearsweep::bench {

struct Case {
  std::string name;
  std::vector<std::string> overrides;  // of the study in KernelRun
  bool settling = true;                // otherwise recording
  bool odeint = false;
  bool one_lane = false;
  std::vector<std::string> states_overrides = {};  // for times_states; empty: none
};

class Contest {
 public:
  explicit Contest(const Case& what);
  void measure(benchmark::State& state);

 private:
  struct Rival {
    std::string name;
    std::size_t periods;
    std::unique_ptr<OdeintSweep> sweep;
  };

  KernelRun kernel_;
  FmaPeak peak_;
  std::unique_ptr<KernelRun> one_lane_, states_;
  std::vector<Rival> rivals_;
};

}  // namespace gearsweep::bench
