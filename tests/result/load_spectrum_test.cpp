// What a load spectrum comes to, by hand.
#include "result/load_spectrum.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "result/example_result.hpp"
#include "study/study.hpp"

namespace gearsweep::testing {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr double kRounding = 1e-12;

// Loads of gear5: load 3 is none, load 4 does not last.
SweepResult result_of(double slope) {
  SweepResult result;
  result.study = read_study(
      "[points]\nnames = ['F1', 'omega', 'time_share']\nnumbers = '''\n"
      "0.1, 0.5, 0.5\n0.2, 1.0, 0.3\n0.0, 0.5, 0.2\n0.9, 2.0, 0\n'''\nslope = " +
          std::to_string(slope) +
          "\n[observe]\nquantities = ['dmf_max', 'dynamic_load_factor', 'contact_class']\n",
      "s.toml");
  result.status = {0, 0, 0, 0};
  result.values = {{0.15, 0.4, 0.03, 9.0}, {1.5, 2.0, kNaN, 10.0}, {0.0, 1.0, 2.0, 1.0}};
  return result;
}

// Cycles are 0.5*0.5 : 0.3*1.0 : 0.2*0.5 = 0.25 : 0.3 : 0.1, of which there are 0.65.
TEST(LoadSpectrum, OfSlopeOneHasMeansOverCycles) {
  const SpectrumAnswers answers = spectrum_answers(result_of(1.0));
  ASSERT_EQ(answers.forces.size(), 1U);
  const SpectrumForce& force = answers.forces.front();
  EXPECT_EQ(force.factor, "dynamic_load_factor");
  EXPECT_NEAR(force.equivalent_load, (0.25 * 0.1 + 0.3 * 0.2) / 0.65, kRounding);
  EXPECT_NEAR(force.equivalent_force, (0.25 * 0.15 + 0.3 * 0.4 + 0.1 * 0.03) / 0.65, kRounding);
}

TEST(LoadSpectrum, CountsDamageByMinersRule) {
  const SpectrumForce force = spectrum_answers(result_of(3.0)).forces.front();
  const double first = 0.25 * std::pow(0.15, 3), second = 0.3 * std::pow(0.4, 3),
               third = 0.1 * std::pow(0.03, 3), sum = first + second + third;
  EXPECT_NEAR(force.equivalent_force, std::cbrt(sum / 0.65), kRounding);
  EXPECT_THAT(force.damage,
              ElementsAre(DoubleNear(first / sum, kRounding), DoubleNear(second / sum, kRounding),
                          DoubleNear(third / sum, kRounding), 0.0));
}

// By time, not by cycles, and without the load of 0 and that which does not last.
TEST(LoadSpectrum, HasItsFactorOverTheTimeUnderLoad) {
  const SpectrumForce force = spectrum_answers(result_of(6.61)).forces.front();
  EXPECT_NEAR(force.mean_factor, (0.5 * 1.5 + 0.3 * 2.0) / 0.8, kRounding);
  EXPECT_EQ(force.max_factor, 2.0);
  EXPECT_EQ(force.max_point, 1U);
}

TEST(LoadSpectrum, SaysHowLongTeethPart) {
  const SpectrumAnswers answers = spectrum_answers(result_of(6.61));
  EXPECT_NEAR(answers.parting_share.value(), 0.5, kRounding);
  EXPECT_THAT(answers.parting, ElementsAre(1U, 2U));
  EXPECT_THAT(answers.failed, IsEmpty());
}

// What rests on a load that diverged is unknown; one that does not last may diverge.
TEST(LoadSpectrum, IsUnknownWhereALoadThatLastsHasNoValue) {
  SweepResult result = result_of(6.61);
  for (const std::size_t point : {1U, 3U}) {
    result.status[point] = STATUS_diverged;
    for (std::vector<double>& map : result.values) map[point] = kNaN;
  }
  const SpectrumAnswers answers = spectrum_answers(result);
  const SpectrumForce& force = answers.forces.front();
  EXPECT_TRUE(std::isnan(force.mean_factor));
  EXPECT_TRUE(std::isnan(force.max_factor));
  EXPECT_TRUE(std::isnan(force.equivalent_force));
  EXPECT_TRUE(std::isnan(answers.parting_share.value()));
  EXPECT_FALSE(std::isnan(force.equivalent_load)) << "that is given";
  EXPECT_THAT(answers.failed, ElementsAre(1U));
}

}  // namespace
}  // namespace gearsweep::testing
