// The 0-1 test for chaos: against its definition, and on motions whose kind is known.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numeric>
#include <string>
#include <vector>

#include "support/bits.hpp"
#include "support/run.hpp"

namespace gearsweep::testing {
namespace {

std::string sweep(const std::string& omegas) {
  return "[model]\npreset = 'coarse'\n[[axes]]\nname = 'omega'\nvalues = [" + omegas +
         "]\n[integrate]\nstop = 'never'\n[observe]\nquantities = ['zero_one', 'poincare']\n";
}

double correlation(const std::vector<double>& a, const std::vector<double>& b) {
  const auto count = static_cast<double>(a.size());
  const double mean_a = std::accumulate(a.begin(), a.end(), 0.0) / count;
  const double mean_b = std::accumulate(b.begin(), b.end(), 0.0) / count;
  double ab = 0.0, aa = 0.0, bb = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    ab += (a[i] - mean_a) * (b[i] - mean_b);
    aa += (a[i] - mean_a) * (a[i] - mean_a);
    bb += (b[i] - mean_b) * (b[i] - mean_b);
  }
  return ab / std::sqrt(aa * bb);
}

// K by its definition: the walk for each angle, and its displacements over all windows.
double zero_one_of(std::vector<double> series) {
  const double mean =
      std::accumulate(series.begin(), series.end(), 0.0) / static_cast<double>(series.size());
  const std::size_t lags = std::min<std::size_t>(series.size() / 10, 128);
  std::vector<double> answers;
  for (int i = 1; i <= 31; ++i) {
    const double turn = 0.6180339887498949 * i;
    const double angle = M_PI / 5.0 * (1.0 + 3.0 * (turn - std::floor(turn)));
    std::vector<std::complex<double>> walk = {0.0};
    for (std::size_t j = 1; j <= series.size(); ++j) {
      walk.push_back(walk.back() +
                     std::polar(1.0, angle * static_cast<double>(j)) * (series[j - 1] - mean));
    }
    std::vector<double> lag, displacement;
    for (std::size_t n = 1; n <= lags; ++n) {
      double sum = 0.0;
      for (std::size_t j = 0; j + lags < series.size(); ++j) {
        sum += std::norm(walk[j + n] - walk[j]);
      }
      lag.push_back(static_cast<double>(n));
      displacement.push_back(sum);
    }
    answers.push_back(correlation(lag, displacement));
  }
  std::nth_element(answers.begin(), answers.begin() + 15, answers.end());
  return answers[15];
}

// The kernel gets the displacements from products of samples; some 1e4 roundings of differences
// leave 1e-9 at worst.
TEST(ZeroOne, IsItsDefinition) {
  for (const std::string record : {"100", "205", "1500"}) {
    SCOPED_TRACE(record);
    const SweepResult result =
        run(sweep("0.53, 1.1, 1.3, 1.4, 1.7, 1.8"), {"integrate.record=" + record});
    for (std::size_t point = 0; point < 6; ++point) {
      EXPECT_NEAR(map_of(result, "zero_one")[point], zero_one_of(samples_of(result, point, 0)),
                  1e-8);
    }
  }
}

// Period 1 in the section is a single value: exactly 0. Period 8 at omega 1.7 and the torus at 1.1
// stay within 0.1 of 0, and the broad chaos at 1.4 within 0.1 of 1; a tenth is what 128 lags leave.
TEST(ZeroOne, SeparatesRegularFromChaotic) {
  const SweepResult result = run(sweep("0.65, 1.1, 1.4, 1.7"), {"integrate.record=2000"});
  const std::vector<double>& k = map_of(result, "zero_one");
  EXPECT_EQ(k[0], 0.0);
  EXPECT_LT(std::abs(k[1]), 0.1);
  EXPECT_GT(k[2], 0.9);
  EXPECT_LT(std::abs(k[3]), 0.1);
}

// fp32 keeps 7 digits of the samples; chaotic trajectories part, but their statistics do not: the
// spread of K over trajectories is a few hundredths. The rounding of a period-1 orbit is no motion.
TEST(ZeroOne, IsTheSameInFp32) {
  const SweepResult result =
      run(sweep("0.65, 1.1, 1.4, 1.7"), {"integrate.record=2000", "integrate.precision=fp32"});
  const std::vector<double>& k = map_of(result, "zero_one");
  EXPECT_EQ(k[0], 0.0);
  EXPECT_LT(std::abs(k[1]), 0.1);
  EXPECT_GT(k[2], 0.9);
  EXPECT_LT(std::abs(k[3]), 0.1);
}

TEST(ZeroOne, NeedsAHundredPeriods) {
  EXPECT_TRUE(std::isnan(map_of(run(sweep("0.7"), {"integrate.record=99"}), "zero_one")[0]));
  EXPECT_FALSE(std::isnan(map_of(run(sweep("0.7"), {"integrate.record=100"}), "zero_one")[0]));
}

// The first has one lane, the others the device's own.
TEST(ZeroOne, HasTheSameBitsHoweverTheWorkIsCut) {
  const std::string study = sweep("0.5, 0.55, 0.6, 0.7, 0.9, 1.1, 1.2, 1.3, 1.4, 1.6, 1.8");
  const SweepResult expected = run(study, {"integrate.lanes=1"});
  for (const std::string cut :
       {"integrate.tile=4", "integrate.round=1", "integrate.round=70", "integrate.round=1000"}) {
    SCOPED_TRACE(cut);
    EXPECT_EQ(different_bits(map_of(run(study, {cut}), "zero_one"), map_of(expected, "zero_one")),
              0U);
  }
}

}  // namespace
}  // namespace gearsweep::testing
