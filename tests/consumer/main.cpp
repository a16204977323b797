// Runs a small study through the installed library and checks the answer: x1 at phase 0 at omega =
// 0.7, preset `consistent`, is 1.26016 (reference value of two independent programs).
#include <cmath>
#include <cstdio>

#include "study/study.hpp"
#include "sweep/sweep.hpp"

int main() {
  const gearsweep::Study study = gearsweep::read_study(R"(
    [model]
    name = "gear5"
    [[axes]]
    name = "omega"
    values = [0.7]
    [integrate]
    settle = 200
    record = 1
    [observe]
    quantities = ["poincare"]
  )",
                                                       "consumer");
  const auto result = gearsweep::run_sweep(study, {});
  const double x1 = result ? result->samples.at(0) : 0.0;
  std::printf("x1 = %.7f\n", x1);
  return std::abs(x1 - 1.26016) < 1e-5 ? 0 : 1;
}
