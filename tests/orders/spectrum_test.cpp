// Spectra: known sines come back, no power is lost, and only whole periods are taken.
#include "orders/spectrum.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "model/error.hpp"

namespace gearsweep {
namespace {

using ::testing::HasSubstr;

// A trace of one channel; the signal is of time in periods.
Trace sampled(std::size_t per_period, std::size_t moments,
              const std::function<double(double)>& signal) {
  Trace trace;
  trace.period = 9.7;
  trace.channels = {{"x1", "b_n", "a state"}};
  trace.values.resize(1);
  for (std::size_t i = 0; i < moments; ++i) {
    const double periods = static_cast<double>(i) / static_cast<double>(per_period);
    trace.tau.push_back(periods * trace.period);
    trace.values[0].push_back(signal(periods));
  }
  return trace;
}

double sine(double amplitude, double order, double periods) {
  return amplitude * std::sin(2.0 * std::numbers::pi * order * periods + 0.4);
}

double mean_square(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value * value;
  return sum / static_cast<double>(values.size());
}

TEST(SpectrumTest, SinesOfKnownAmplitudeAndOrderComeBack) {
  // Order 1, a subharmonic and a high order, on a mean that is a thousand times larger.
  const Trace trace = sampled(64, 64 * 12, [](double periods) {
    return 250.0 + sine(0.25, 1.0, periods) + sine(1e-3, 1.0 / 3.0, periods) +
           sine(4.0, 20.5, periods);
  });
  const Spectrum spectrum = amplitude_spectrum(trace, 0, 0);
  EXPECT_NEAR(spectrum.mean, 250.0, 1e-10);  // rounding of 768 numbers
  EXPECT_DOUBLE_EQ(spectrum.order_step, 1.0 / 12.0);
  ASSERT_EQ(spectrum.amplitude.size(), 64U * 12U / 2U + 1U);
  const auto at = [&](double order) {
    return decibels(
        spectrum.amplitude[static_cast<std::size_t>(std::round(order / spectrum.order_step))]);
  };
  // What is asked for is 0.01 dB; nothing but rounding is in the way.
  EXPECT_NEAR(at(1.0), 20.0 * std::log10(0.25), 1e-8);
  EXPECT_NEAR(at(1.0 / 3.0), -60.0, 1e-8);
  EXPECT_NEAR(at(20.5), 20.0 * std::log10(4.0), 1e-8);
  // Beyond the bins beside a line there is rounding only.
  EXPECT_LT(at(10.0), -200.0);
}

// A period of five mesh periods: its fifth line is the mesh.
TEST(SpectrumTest, OrdersAreThoseOfTheMesh) {
  Trace trace = sampled(64, 64 * 12, [](double periods) { return sine(0.25, 5.0, periods); });
  trace.mesh_periods = 5.0;
  const Spectrum spectrum = amplitude_spectrum(trace, 0, 0);
  EXPECT_NEAR(spectrum.amplitude[static_cast<std::size_t>(std::round(1.0 / spectrum.order_step))],
              0.25, 1e-12);
}

TEST(SpectrumTest, NoPowerIsLost) {
  // Noise, so that every bin takes part, of an even and an odd number of samples.
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  for (const std::size_t count : {96U, 105U}) {
    std::vector<double> samples(count);
    for (double& sample : samples) sample = 3.0 + normal(random);
    const Spectrum spectrum = amplitude_spectrum(samples, 3);
    std::vector<double> windowed;
    for (std::size_t i = 0; i < count; ++i) {
      const double half_turn =
          std::numbers::pi * static_cast<double>(i) / static_cast<double>(count);
      windowed.push_back(std::sin(half_turn) * std::sin(half_turn) * (samples[i] - spectrum.mean));
    }
    // Parseval: the mean square is the sum over the bins, 1/2 of the amplitude squared, or all of
    // it at the ends, which have no negative frequency beside them; times the window's mean
    // squared.
    double sum = 0.0;
    for (std::size_t bin = 0; bin < spectrum.amplitude.size(); ++bin) {
      const bool is_end = bin == 0 || 2 * bin == count;
      sum += (is_end ? 1.0 : 0.5) * spectrum.amplitude[bin] * spectrum.amplitude[bin] / 4.0;
    }
    EXPECT_NEAR(sum, mean_square(windowed), 1e-13);  // rounding of a hundred numbers near 1
  }
}

TEST(SpectrumTest, TheMeanSquareOfAPeriodicSignalIsInItsLines) {
  const Trace trace = sampled(128, 128 * 8, [](double periods) {
    return sine(2.0, 1.0, periods) + sine(0.5, 2.5, periods);
  });
  const Spectrum spectrum = amplitude_spectrum(trace, 0, 0);
  // Half the squares of the amplitudes over the noise bandwidth of Hann's window, 1.5 bins.
  double sum = 0.0;
  for (const double amplitude : spectrum.amplitude) sum += amplitude * amplitude / 2.0 / 1.5;
  EXPECT_NEAR(sum, mean_square(trace.values[0]), 1e-12);  // rounding
  EXPECT_NEAR(sum, (4.0 + 0.25) / 2.0, 1e-12);
}

TEST(SpectrumTest, TakesTheLastWholePeriods) {
  // The first six periods are another signal, the half period at the end is left out.
  const Trace trace = sampled(32, 32 * 10 + 16, [](double periods) {
    return periods < 6.0 || periods >= 10.0 ? 100.0 : sine(1.5, 3.0, periods);
  });
  const Spectrum spectrum = amplitude_spectrum(trace, 0, 4);
  EXPECT_DOUBLE_EQ(spectrum.order_step, 0.25);
  EXPECT_NEAR(spectrum.amplitude[12], 1.5, 1e-12);  // rounding
  EXPECT_NEAR(spectrum.amplitude[0], 0.0, 1e-12);
}

std::string refusal(const Trace& trace) {
  try {
    amplitude_spectrum(trace, 0, 0);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(SpectrumTest, RefusesWhatIsNoWholePeriodOfEvenMoments) {
  const auto constant = [](double) { return 1.0; };
  EXPECT_EQ(refusal(sampled(32, 32, constant)), "accepted");
  EXPECT_THAT(refusal(sampled(32, 31, constant)), HasSubstr("31 of its 32 moments"));
  Trace uneven = sampled(32, 64, constant);
  uneven.tau[7] += 0.01;
  EXPECT_THAT(refusal(uneven), HasSubstr("--samples-per-period 256"));
  Trace fraction = sampled(32, 64, constant);
  fraction.period *= 1.01;
  EXPECT_THAT(refusal(fraction), HasSubstr("a whole number"));
  EXPECT_THAT(refusal(sampled(32, 1, constant)), HasSubstr("evenly"));
}

}  // namespace
}  // namespace gearsweep
