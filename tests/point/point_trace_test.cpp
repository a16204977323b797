// Traces of points, of studies with axes and without.
#include "point/point_trace.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <complex>
#include <iterator>
#include <numbers>

#include "model/error.hpp"
#include "orders/spectrum.hpp"

namespace gearsweep::testing {
namespace {

Study oscillator() {
  return read_study(
      "[model]\nname = 'duffing'\n[[axes]]\nname = 'omega'\nvalues = [0.9, 1.1]\n"
      "[integrate]\nsettle = 20\nrecord = 3\n[observe]\nquantities = ['x_rms']\n",
      "test");
}

PointTraces traces_of(const Study& study, const std::vector<NamedValue>& values) {
  PointTraces found;
  EXPECT_TRUE(add_point_trace(study, find_place(study, values, ""), {}, 32, {}, &found));
  return found;
}

TEST(PointTrace, HasItsLabelAndTheParametersOfItsPlace) {
  const PointTraces found = traces_of(oscillator(), {{"omega", 1.1}, {"x", 0.5}});
  EXPECT_EQ(found.labels, std::vector<std::string>{"omega=1.1, x=0.5"});
  EXPECT_EQ(found.placed, std::vector<std::string>{"omega"});
  EXPECT_EQ(found.traces.front().tau.size(), 96U);
}

TEST(PointTrace, OfAStudyWithoutAxesIsThatOfItsSetting) {
  Study study = oscillator();
  const PointTraces with = traces_of(study, {{"omega", 1.1}});
  study.axes.clear();
  EXPECT_EQ(traces_of(study, {{"omega", 1.1}}).traces.front().values, with.traces.front().values);
  study.setting.parameters[static_cast<std::size_t>(study.model->find_parameter("omega"))] = 1.1;
  EXPECT_EQ(traces_of(study, {}).traces.front().values, with.traces.front().values);
}

// One period of the forcing of a gear with a cracked tooth is 19 mesh periods.
Study cracked() {
  return read_study(
      "[model]\nname = 'gear5'\npreset = 'coarse'\n[parameters]\nzp = 19\ncycle = 19\n"
      "damage_p = 0.4\n[[axes]]\nname = 'omega'\nvalues = [0.8]\n"
      "[integrate]\nsettle = 2\nrecord = 2\nengine = 'reference'\n"
      "[observe]\nquantities = ['x1_rms']\n",
      "test");
}

TEST(PointTrace, CountsMeshPeriods) {
  const Study short_one = with_windows(cracked(), {20, 8});
  EXPECT_EQ(short_one.integrate.settle, 2U);
  EXPECT_EQ(short_one.integrate.record, 1U);
  EXPECT_EQ(short_one.integrate.stop, Stop::never);
  EXPECT_EQ(with_windows(cracked(), {{}, 39}).integrate.record, 3U);
  EXPECT_EQ(with_windows(cracked(), {0, {}}).integrate.settle, 0U);
  EXPECT_EQ(with_windows(cracked(), {{}, {}}).toml, cracked().toml);
  EXPECT_EQ(with_windows(oscillator(), {7, 5}).integrate.record, 5U);
  // A step that a map has found is not in the text.
  Study found = oscillator();
  settle_step(FoundStep{0.07, 4}, &found);
  EXPECT_EQ(with_windows(found, {7, 5}).integrate.max_step, 0.07);
  EXPECT_EQ(with_windows(found, {7, 5}).integrate.orbit_steps, 4U);
  EXPECT_EQ(traces_of(short_one, {}).traces.front().tau.size(), 19U * 32U);
}

// Amplitude of this line over a period of a trace of both ends of each step: Fourier's integral by
// the trapezoidal rule, which knows no sampling rate.
double line_of(const Trace& trace, const std::vector<double>& values, double line) {
  std::complex<double> sum = 0.0;
  const auto at = [&](std::size_t i) {
    return std::polar(values[i], -2.0 * std::numbers::pi * line * trace.tau[i] / trace.period);
  };
  for (std::size_t i = 0; i + 1 < trace.tau.size(); ++i) {
    sum += 0.5 * (trace.tau[i + 1] - trace.tau[i]) * (at(i) + at(i + 1));
  }
  return 2.0 * std::abs(sum) / trace.period;
}

// With 256 samples in the whole period of 19 meshes, the mesh orders above 6 would come down
// between the sidebands. At whole orders samples of a force that jumps keep an error of the jump
// over their number.
TEST(PointTrace, HasTheSidebandsOfACrackedTooth) {
  const Study study = with_windows(cracked(), {{}, 19});
  PointTraces both;
  for (const std::size_t samples : {256U, 0U}) {
    ASSERT_TRUE(add_point_trace(study, find_place(study, {}, ""), {}, samples, {}, &both));
  }
  const Trace& sampled = both.traces.front();
  const Trace& fine = both.traces.back();
  const auto force = static_cast<std::size_t>(
      std::distance(sampled.channels.begin(),
                    std::ranges::find(sampled.channels, std::string("dmf"), &ChannelInfo::name)));
  const Spectrum spectrum = amplitude_spectrum(sampled.values[force], 1, SpectrumWindow::none);
  double largest = 0.0;
  for (std::size_t line = 1; line <= 60; ++line) {
    largest = std::max(largest, spectrum.amplitude[line]);
  }
  for (std::size_t line = 1; line <= 60; ++line) {
    if (line % 19 == 0) continue;
    const double exact = line_of(fine, fine.values[force], static_cast<double>(line));
    EXPECT_NEAR(spectrum.amplitude[line], exact, 0.02 * exact + 0.002 * largest) << line << "/19";
  }
}

TEST(PointTrace, SaysWhenItIsTooLong) {
  const Study study = with_windows(oscillator(), {{}, 10'000'000});
  PointTraces found;
  const Place place = find_place(study, {{"omega", 1.0}}, "");
  try {
    add_point_trace(study, place, {}, std::size_t{1} << 20U, {}, &found);
    ADD_FAILURE() << "it was taken";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("GB of memory"));
  }
}

// A tolerance that was asked for needs the step that a map has found.
TEST(PointTrace, TakesTheStepOfItsMap) {
  Study study = oscillator();
  const double own = study.integrate.max_step;
  study.integrate.tolerance = 1e-3;
  Study plain = study;
  settle_step(std::nullopt, &plain);
  EXPECT_EQ(plain.integrate.max_step, own);
  EXPECT_EQ(plain.integrate.tolerance, 0.0);
  study.integrate.is_tolerance_asked = true;
  EXPECT_THROW(settle_step(std::nullopt, &study), InputError);
  settle_step(FoundStep{0.07, 4}, &study);
  EXPECT_EQ(study.integrate.max_step, 0.07);
  EXPECT_EQ(study.integrate.orbit_steps, 4U);
}

TEST(PointTrace, AddsNothingWhenItIsStopped) {
  const std::atomic<bool> stop = true;
  SweepOptions options;
  options.stop = &stop;
  PointTraces found;
  const Study study = oscillator();
  const Place place = find_place(study, {{"omega", 1.0}}, "");
  EXPECT_FALSE(add_point_trace(study, place, {}, 32, options, &found));
  EXPECT_TRUE(found.traces.empty());
}

}  // namespace
}  // namespace gearsweep::testing
