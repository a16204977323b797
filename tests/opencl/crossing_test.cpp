// Where in a step a limit of the contact is crossed, as the kernels find it.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <random>

#include "dialect.h"
#include "sweep_types.h"

namespace gearsweep::testing {
namespace {

namespace fp64 {
using std::fabs;
using std::sqrt;
using real = double;
using scalar = double;
#include "equations/headers/gear1.h"
// The integrator needs the model.
#include "rk4/rk4.h"
}  // namespace fp64

namespace fp32 {
using std::fabs;
using std::sqrt;
using real = float;
using scalar = float;
#include "equations/headers/gear1.h"
// The integrator needs the model.
#include "rk4/rk4.h"
}  // namespace fp32

// The share of the step behind the root of the parabola through p at the step's start, its middle
// and its end, by bisection.
double share_behind_root(double start, double middle, double end) {
  const auto parabola = [&](double u) {
    return (1.0 - 2.0 * u) * (1.0 - u) * start + 4.0 * u * (1.0 - u) * middle +
           u * (2.0 * u - 1.0) * end;
  };
  double low = 0.0, high = 1.0;
  for (int i = 0; i < 60; ++i) {
    const double between = 0.5 * (low + high);
    ((parabola(between) > 0.0) == (start > 0.0) ? low : high) = between;
  }
  return 1.0 - high;
}

// A deflection beyond the limit is a number of any size, and steps often begin or end on the limit
// itself or a hair beside it.
template <class Real>
Real some_penetration(std::mt19937* random) {
  const Real size = std::pow(Real{10}, Real(std::uniform_int_distribution(-9, 2)(*random)));
  const int kind = std::uniform_int_distribution(0, 9)(*random);
  return kind == 0 ? Real{0} : size * std::uniform_real_distribution<Real>(-1, 1)(*random);
}

TEST(CrossingLocate, FindsTheParabolasRoot) {
  std::mt19937 random(7);
  std::size_t crossings = 0;
  for (int i = 0; i < 100000; ++i) {
    const double p[] = {some_penetration<double>(&random), some_penetration<double>(&random), 0.0,
                        some_penetration<double>(&random)};
    double all[] = {p[0], p[1], p[1], p[3]};
    fp64::Crossing crossing;
    fp64::crossing_locate(1.0, &crossing, all);
    if (!crossing.any) continue;
    ++crossings;
    // A root near the step's start or end is known to rounding of the share; one of two that
    // nearly meet to its square root.
    ASSERT_NEAR(crossing.after, share_behind_root(p[0], p[1], p[3]), 1e-7)
        << p[0] << " " << p[1] << " " << p[3];
  }
  EXPECT_GT(crossings, 30000U);
}

// Whatever the rounding: a share that is no number would mark the point as diverged.
TEST(CrossingLocate, IsAShareOfTheStepInFp32) {
  std::mt19937 random(8);
  for (int i = 0; i < 1000000; ++i) {
    const float start = some_penetration<float>(&random);
    const float middle = some_penetration<float>(&random);
    float p[] = {start, middle, middle, some_penetration<float>(&random)};
    for (const float flank : {1.0F, -1.0F}) {
      fp32::Crossing crossing;
      fp32::crossing_locate(flank, &crossing, p);
      if (!crossing.any) continue;
      ASSERT_GE(crossing.after, 0.0F) << p[0] << " " << p[1] << " " << p[3];
      ASSERT_LE(crossing.after, 1.001F) << p[0] << " " << p[1] << " " << p[3];
    }
  }
}

}  // namespace
}  // namespace gearsweep::testing
