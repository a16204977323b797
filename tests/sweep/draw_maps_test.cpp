// Statistics over draws: of numbers whose answers are known, and of a linear oscillator.
#include "sweep/draw_maps.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "study/detail/draws.hpp"
#include "support/run.hpp"

namespace gearsweep::testing {
namespace {

TEST(DrawStatistics, PercentilesAreLinearBetweenNumbers) {
  const std::vector<double> sorted = {1.0, 2.0, 4.0, 8.0, 16.0};
  EXPECT_EQ(percentile_of(sorted, 0.0), 1.0);
  EXPECT_EQ(percentile_of(sorted, 50.0), 4.0);
  EXPECT_EQ(percentile_of(sorted, 62.5), 6.0);
  EXPECT_EQ(percentile_of(sorted, 100.0), 16.0);
}

// Ishigami's function with a = 7, b = 0.1: its indices in closed form (Saltelli et al., Sensitivity
// Analysis, 2000).
TEST(DrawStatistics, SobolIndicesOfIshigamisFunction) {
  constexpr std::size_t kSamples = 20000;
  const auto x = [](std::size_t parameter, std::size_t row) {
    const std::string name(1, static_cast<char>('a' + static_cast<char>(parameter)));
    return std::numbers::pi * (2.0 * uniform_at(3, name, row) - 1.0);
  };
  std::vector<double> values;
  for (std::size_t part = 0; part < 5; ++part) {
    for (std::size_t row = 0; row < kSamples; ++row) {
      double at[3];
      for (std::size_t i = 0; i < 3; ++i) {
        at[i] = x(i, part == 1 || part == i + 2 ? kSamples + row : row);
      }
      values.push_back(std::sin(at[0]) + 7.0 * std::sin(at[1]) * std::sin(at[1]) +
                       0.1 * std::pow(at[2], 4) * std::sin(at[0]));
    }
  }
  const SobolIndices indices = sobol_indices(values, kSamples, 3);
  const double first[] = {0.3139, 0.4424, 0.0}, total[] = {0.5576, 0.4424, 0.2437};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(indices.first[i], first[i], 4.0 * indices.first_error[i]) << i;
    EXPECT_LT(indices.first_error[i], 0.02) << i;
    // Squares are as large as their mean, and 1 / sqrt(20000) is 0.007 of it.
    EXPECT_NEAR(indices.total[i], total[i], 0.02) << i;
  }
}

// x'' + 0.2 x' + x = a sin(omega t): the amplitude is a / |1 - omega^2 + 0.2 i omega|.
const std::string kLinear =
    "[model]\nname = 'duffing'\n[parameters]\ndamping = 0.2\nlinear = 1.0\ncubic = 0.0\n"
    "amplitude = 1.0\n[[axes]]\nname = 'omega'\nvalues = [0.7, 1.3]\n"
    "[integrate]\nsettle = 60\nrecord = 4\nmax_step = 0.1\n[observe]\nquantities = ['x_rms']\n";

double rms_at(double amplitude, double omega) {
  return amplitude / std::hypot(1.0 - omega * omega, 0.2 * omega) / std::numbers::sqrt2;
}

// The rms goes with the amplitude, so its draws are those of the amplitude, but for a factor.
TEST(UncertainSweep, ANormalAmplitudeGivesANormalResponse) {
  const SweepResult result = run(kLinear +
                                 "[uncertain]\nsamples = 400\npercentiles = [10, 50]\n"
                                 "amplitude = {distribution = 'normal', mean = 2, std = 0.1}\n");
  for (std::size_t point = 0; point < 2; ++point) {
    const double factor = rms_at(1.0, result.study.axes.front().values[point]);
    const double error = 4.0 * 0.1 * factor / std::sqrt(400.0);
    EXPECT_NEAR(map_of(result, "x_rms")[point], factor, 1e-4 * factor);  // with amplitude 1
    EXPECT_NEAR(map_of(result, "x_rms_sample_mean")[point], 2.0 * factor, error);
    EXPECT_NEAR(map_of(result, "x_rms_sample_std")[point], 0.1 * factor, error / std::sqrt(2.0));
    EXPECT_NEAR(map_of(result, "x_rms_p10")[point], (2.0 - 0.128155) * factor, 2.0 * error);
    EXPECT_NEAR(map_of(result, "x_rms_p50")[point], 2.0 * factor, 1.5 * error);
    EXPECT_EQ(map_of(result, "diverged_share")[point], 0.0);
  }
}

// A factor goes with the value of the axis; the mean is that of the closed form over the
// distribution, by the midpoint rule.
TEST(UncertainSweep, AToleranceOfAnAxisIsRelativeToItsValue) {
  const SweepResult result =
      run(kLinear +
          "[uncertain]\nsamples = 400\n"
          "omega = {distribution = 'uniform', from = 0.95, to = 1.05, relative = true}\n");
  for (std::size_t point = 0; point < 2; ++point) {
    const double omega = result.study.axes.front().values[point];
    double mean = 0.0, square = 0.0;
    constexpr int kCells = 1000;
    for (int cell = 0; cell < kCells; ++cell) {
      const double rms = rms_at(1.0, omega * (0.95 + 0.1 * (cell + 0.5) / kCells));
      mean += rms / kCells;
      square += rms * rms / kCells;
    }
    const double deviation = std::sqrt(square - mean * mean);
    EXPECT_NEAR(map_of(result, "x_rms_sample_mean")[point], mean, 4.0 * deviation / 20.0);
    // 1 / sqrt(2 n) is 0.035: more than four of these.
    EXPECT_NEAR(map_of(result, "x_rms_sample_std")[point], deviation, 0.2 * deviation);
  }
}

// log x_rms = log a + g(omega), so that of a product the indices follow from the two factors:
// with E and V of each, V1 = V_a E_g^2, V2 = V_g E_a^2, V12 = V_a V_g.
TEST(UncertainSweep, SobolIndicesOfAProduct) {
  const std::string no_axes =
      kLinear.substr(0, kLinear.find("[[axes]]")) + kLinear.substr(kLinear.find("[integrate]"));
  const SweepResult result = run(no_axes +
                                 "[uncertain]\nsamples = 500\nsobol = true\n"
                                 "amplitude = {distribution = 'uniform', from = 1, to = 2}\n"
                                 "omega = {distribution = 'uniform', from = 0.6, to = 0.8}\n");
  double mean = 0.0, square = 0.0;
  constexpr int kCells = 1000;
  for (int cell = 0; cell < kCells; ++cell) {
    const double rms = rms_at(1.0, 0.6 + 0.2 * (cell + 0.5) / kCells);
    mean += rms / kCells;
    square += rms * rms / kCells;
  }
  const double of_omega = square - mean * mean, of_amplitude = 1.0 / 12.0;
  const double v1 = of_amplitude * mean * mean, v2 = of_omega * 1.5 * 1.5;
  const double all = v1 + v2 + of_amplitude * of_omega;
  const std::vector<double>& first = map_of(result, "x_rms_sobol_first");
  const std::vector<double>& error = map_of(result, "x_rms_sobol_first_error");
  const std::vector<double>& total = map_of(result, "x_rms_sobol_total");
  const bool is_amplitude_first =
      result.study.uncertain.parameters.front().draws.name == "amplitude";
  const std::size_t amplitude = is_amplitude_first ? 0 : 1, omega = 1 - amplitude;
  EXPECT_NEAR(first[amplitude], v1 / all, 4.0 * error[amplitude]);
  EXPECT_NEAR(first[omega], v2 / all, 4.0 * error[omega]);
  EXPECT_LT(std::max(error[0], error[1]), 0.08);
  // Squares are as large as their mean, 1 / sqrt(500) is 0.045 of it, and the variance adds to it.
  EXPECT_NEAR(total[amplitude], 1.0 - v2 / all, 0.1);
  EXPECT_NEAR(total[omega], 1.0 - v1 / all, 0.1);
}

const std::string kGearDraws =
    "[model]\npreset = 'coarse'\n[[axes]]\nname = 'omega'\nvalues = [0.6, 1.1, 1.3]\n"
    "[integrate]\nsettle = 40\nrecord = 8\nmax_step = 0.2\nstop = 'never'\n"
    "[observe]\nquantities = ['dmf_max', 'contact_class']\n"
    "[uncertain]\nsamples = 13\npercentiles = [0, 100]\n"
    "m1 = {distribution = 'uniform', from = 0.3, to = 0.4}\n"
    "eps = {distribution = 'triangular', from = 1.6, mode = 1.7, to = 1.8}\n";

TEST(UncertainSweep, MapsDoNotDependOnTheCutIntoTiles) {
  const SweepResult whole = run(kGearDraws);
  const SweepResult cut = run(kGearDraws, {"integrate.tile=5"});
  ASSERT_EQ(whole.values.size(), cut.values.size());
  for (std::size_t i = 0; i < whole.values.size(); ++i) EXPECT_EQ(whole.values[i], cut.values[i]);
}

// Each draw is the point that a study of these very parameters has; the gears are unlike there.
TEST(UncertainSweep, DrawsAreWhatAListOfTheirParametersGives) {
  const SweepResult result = run(kGearDraws, {"uncertain.keep=true"});
  const auto values_of = [&](const std::string& name) {
    return std::ranges::find(result.study.uncertain.parameters, name,
                             [](const auto& parameter) { return parameter.draws.name; })
        ->draws.values;
  };
  std::string points = "[points]\nnames = ['m1', 'eps']\nnumbers = '''\n";
  const std::vector<double> mass = values_of("m1"), ratio = values_of("eps");
  for (std::size_t i = 0; i < mass.size(); ++i) {
    points += fmt::format("{} {}\n", mass[i], ratio[i]);
  }
  const std::string alone = kGearDraws.substr(0, kGearDraws.find("[uncertain]"));
  const SweepResult list = run(alone + points + "'''\n");
  const std::vector<double>& force = map_of(list, "dmf_max");
  const std::vector<double>& classes = map_of(list, "contact_class");
  for (std::size_t point = 0; point < 3; ++point) {
    std::vector<double> of_point;
    const auto kept = [&](const std::string& name, std::size_t draw) {
      return map_of(result, name + "_draws")[point * mass.size() + draw];
    };
    double double_sided = 0.0;
    for (std::size_t draw = 0; draw < mass.size(); ++draw) {
      of_point.push_back(force[draw * 3 + point]);
      EXPECT_EQ(kept("dmf_max", draw), of_point.back());
      EXPECT_EQ(kept("contact_class", draw), classes[draw * 3 + point]);
      double_sided += classes[draw * 3 + point] == 2.0 ? 1.0 : 0.0;
    }
    const auto [smallest, largest] = std::ranges::minmax(of_point);
    EXPECT_EQ(map_of(result, "dmf_max_p0")[point], smallest);
    EXPECT_EQ(map_of(result, "dmf_max_p100")[point], largest);
    EXPECT_DOUBLE_EQ(map_of(result, "contact_class_double_sided_share")[point],
                     double_sided / static_cast<double>(mass.size()));
  }
}

}  // namespace
}  // namespace gearsweep::testing
