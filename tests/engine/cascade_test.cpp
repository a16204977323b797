// Period doubling and loss of symmetry at the published parameters: bifurcation points found by
// shooting, to 8 digits, from the description of the models, section "Published answers".
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "study/builtin_models.hpp"
#include "support/run.hpp"
#include "support/study_text.hpp"

namespace gearsweep::testing {
namespace {

// How many different values there are among the samples, up to the tolerance.
std::size_t distinct(std::vector<double> samples, double tolerance) {
  std::sort(samples.begin(), samples.end());
  std::size_t count = 1;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    if (samples[i] - samples[i - 1] > tolerance) ++count;
  }
  return count;
}

// The period of each point's motion. Just beyond a doubling, the two values that one has become
// stand apart by the square root of the distance to it, more than 1e-3 within a cell of these
// sweeps; just before it, 2000 periods have brought the motion closer than that.
std::vector<std::size_t> periods_of(const SweepResult& result) {
  std::vector<std::size_t> periods;
  for (std::size_t point = 0; point < result.status.size(); ++point) {
    periods.push_back(distinct(samples_of(result, point, 1), 1e-3));  // of v
  }
  return periods;
}

// The published point lies in the cell in which the period first reaches `period`.
void expect_doubling(const std::vector<double>& swept, const std::vector<std::size_t>& periods,
                     std::size_t period, double published) {
  std::size_t i = 1;
  while (i + 1 < swept.size() && periods[i] < period) ++i;
  EXPECT_EQ(periods[i - 1], period / 2);
  EXPECT_EQ(periods[i], period);
  EXPECT_LE(std::min(swept[i - 1], swept[i]), published) << "period " << period;
  EXPECT_GE(std::max(swept[i - 1], swept[i]), published) << "period " << period;
}

constexpr const char* kIntegrate = R"(
  [integrate]
  settle = 2000
  record = 64
  steps_per_period = 128
)";

// The mean angle of a motion that is its own mirror image is 0; it tears away as the square root of
// the distance beyond the published Q, which lies within the cell between the last broken motion
// and the first symmetric one. 4000 periods leave 1e-11 of the start at the nearest point.
TEST(Cascade, PendulumLosesItsSymmetryAtThePublishedDamping) {
  const double published = 1.0 / 1.24693151;
  const SweepResult result = run(std::string(R"(
    [model]
    name = "pendulum"
    preset = "cascade"
    [[axes]]
    name = "damping"
    from = 0.7905
    to = 0.8135
    count = 24
    [initial]
    state = {x = 0.1}
    [integrate]
    settle = 4000
    record = 2
    steps_per_period = 128
  )") + observe_all_of(*find_model("pendulum")));
  for (std::size_t i = 0; i < result.status.size(); ++i) {
    const double damping = result.study.axes[0].values[i];
    const double mean = std::abs(map_of(result, "x_mean")[i]);
    if (damping < published) {
      EXPECT_GT(mean, 0.05) << damping;
    } else {
      EXPECT_LT(mean, 1e-9) << damping;
    }
  }
}

TEST(Cascade, PendulumDoublesAtThePublishedDamping) {
  // Ascending damping = 1/Q, so from the end of the cascade backwards.
  std::string values;
  std::vector<double> Q;
  for (int i = 0; i < 80; ++i) {
    Q.push_back(1.3755 - 0.0005 * i);
    values += fmt::format("{:.17g}, ", 1.0 / Q.back());
  }
  const SweepResult result =
      run("[model]\nname = 'pendulum'\npreset = 'cascade'\n[[axes]]\nname = 'damping'\nvalues = [" +
          values + "]\n" + kIntegrate + observe_all_of(*find_model("pendulum")));
  std::vector<std::size_t> periods = periods_of(result);
  std::reverse(Q.begin(), Q.end());
  std::reverse(periods.begin(), periods.end());
  expect_doubling(Q, periods, 2, 1.34921264);
  expect_doubling(Q, periods, 4, 1.37012224);
  expect_doubling(Q, periods, 8, 1.37457590);
}

TEST(Cascade, TwoWellDuffingDoublesAtThePublishedForcing) {
  const SweepResult result = run(std::string(R"(
    [model]
    name = "duffing"
    preset = "two_well"
    [parameters]
    damping = 0.3
    omega = 1.2
    phase = 1.5707963267948966
    [[axes]]
    name = "amplitude"
    from = 0.26
    to = 0.2915
    count = 64
    [initial]
    state = {x = 1.0}
  )") + kIntegrate + "[observe]\nquantities = ['poincare']\npoincare = ['x', 'v']\n");
  const std::vector<std::size_t> periods = periods_of(result);
  const std::vector<double>& amplitudes = result.study.axes[0].values;
  expect_doubling(amplitudes, periods, 2, 0.26558179);
  expect_doubling(amplitudes, periods, 4, 0.28669316);
  expect_doubling(amplitudes, periods, 8, 0.29108991);
}

}  // namespace
}  // namespace gearsweep::testing
