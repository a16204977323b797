// What comes back once per turn of a shaft: periods of several mesh periods.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "model/error.hpp"
#include "plan/plan.hpp"
#include "support/mesh.hpp"
#include "support/run.hpp"
#include "support/settings.hpp"
#include "support/study_text.hpp"
#include "sweep/trace_run.hpp"
#include "verify/detail/host_stepper.hpp"

namespace gearsweep::testing {
namespace {

using ::testing::HasSubstr;

std::string few_teeth(const std::string& parameters, const std::string& omega = "0.65, 0.8") {
  return "[model]\npreset = 'coarse'\nerror = 'series'\n[parameters]\nzp = 5\nteeth_ratio = 1.4\n" +
         parameters + "[[axes]]\nname = 'omega'\nvalues = [" + omega + "]\n";
}

// Nothing tells the five mesh periods of a sound pinion's turn apart.
TEST(FaultyGear, WithoutFaultsTheMotionIsThatOfTheMesh) {
  const auto integrate = [](const char* steps) {
    return "[integrate]\nsettle = 300\nrecord = 20\nsteps_per_period = " + std::string(steps) +
           "\n" + kObserveGear5;
  };
  const SweepResult mesh = run(few_teeth("") + integrate("256"));
  const SweepResult turn =
      run(few_teeth("cycle = 5\ndamage_p = 0.0\nrunout_p = 0.0\n") + integrate("1280"));
  for (std::size_t point = 0; point < 2; ++point) {
    EXPECT_EQ(mesh.on_orbit[point], 1);  // of one period, in which the sections recur
    EXPECT_EQ(turn.on_orbit[point], 1);
    EXPECT_NEAR(samples_of(mesh, point, 0)[1], samples_of(mesh, point, 0)[0], 1e-9);
    EXPECT_NEAR(samples_of(turn, point, 0)[1], samples_of(turn, point, 0)[0], 1e-9);
    for (const char* quantity : {"dmf_max", "x1_rms"}) {
      EXPECT_NEAR(map_of(turn, quantity)[point], map_of(mesh, quantity)[point], 1e-9) << quantity;
    }
    for (std::size_t state = 0; state < 10; ++state) {
      EXPECT_NEAR(samples_of(turn, point, state)[0], samples_of(mesh, point, state)[0], 1e-9);
    }
  }
}

const std::string kFaulty =
    "cycle = 5\ne0 = [0.4, 0.05]\nrunout_p = 1.5\nrunout_phase_p = 0.7\ndamage_p = 0.4\n";

TEST(FaultyGear, TheReferenceEngineAgrees) {
  const std::string rest =
      "[integrate]\nsettle = 3\nrecord = 2\nstop = 'never'\nsteps_per_period = 640\n" +
      kObserveGear5;
  const SweepResult kernel = run(few_teeth(kFaulty, "0.45, 0.7") + rest);
  const SweepResult second =
      run(few_teeth(kFaulty, "0.45, 0.7") + rest, {"integrate.engine=reference"});
  for (std::size_t point = 0; point < 2; ++point) {
    EXPECT_NEAR(map_of(kernel, "dmf_max")[point], map_of(second, "dmf_max")[point], 1e-11);
    for (std::size_t state = 0; state < 10; ++state) {
      for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_NEAR(samples_of(kernel, point, state)[i], samples_of(second, point, state)[i],
                    1e-11);
      }
    }
  }
}

TEST(FaultyGear, KernelAndHostHaveTheSameBits) {
  const std::string study =
      few_teeth(kFaulty, "0.45, 0.7") +
      "[integrate]\nsettle = 3\nrecord = 1\nstop = 'never'\nsteps_per_period = 320\n"
      "contract = false\n" +
      kObserveGear5;
  const SweepResult result = run(with_whole_kernel(read_study(study, "test.toml")));
  const Plan plan(result.study, result.study.points());
  for (std::size_t point = 0; point < 2; ++point) {
    const std::vector<double> host = step_on_host(plan, point, 4);
    for (std::size_t state = 0; state < 10; ++state) {
      EXPECT_EQ(samples_of(result, point, state)[0], host[state]);
    }
  }
}

// The amplitude of an order of the mesh in a channel of an evenly sampled trace.
double amplitude(const Trace& trace, const std::string& channel, double order) {
  const auto found = std::ranges::find(trace.channels, channel, &ChannelInfo::name);
  const std::vector<double>& values =
      trace.values[static_cast<std::size_t>(found - trace.channels.begin())];
  std::complex<double> sum = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double mesh_periods = trace.tau[i] / trace.period * trace.mesh_periods;
    sum += values[i] * std::polar(1.0, -2.0 * std::numbers::pi * order * mesh_periods);
  }
  return 2.0 * std::abs(sum) / static_cast<double>(values.size());
}

Trace traced(const std::string& parameters) {
  const Study study =
      read_study(few_teeth(parameters, "0.7") +
                     "[integrate]\nsettle = 200\nrecord = 1\nstop = 'never'\n" + kObserveGear5,
                 "test.toml");
  // A whole number of samples in each mesh period: what is too fast for them falls on mesh orders.
  return *run_trace(study, 35 * 128, {});
}

// Stiffness times the slow error of an eccentric pinion: lines at mesh order 1 +- 1/5, 2 +- 1/5;
// nothing at the orders of the gear, 1 +- 1/7, which has none.
TEST(FaultyGear, SidebandsStandOneTurnOfThePinionBesideTheMeshOrders) {
  const Trace sound = traced("e0 = [0.1]\ncycle = 35\n");
  const Trace eccentric = traced("e0 = [0.1]\ncycle = 35\nrunout_p = 1.0\n");
  const double mesh = amplitude(eccentric, "dmf", 1.0);
  EXPECT_GT(mesh, 1e-3);
  for (const double centre : {1.0, 2.0}) {
    for (const double side : {-1.0, 1.0}) {
      const double line = amplitude(eccentric, "dmf", centre + side / 5.0);
      EXPECT_GT(line, 1e-3 * mesh) << centre << " " << side;
      EXPECT_LT(amplitude(sound, "dmf", centre + side / 5.0), 1e-6 * line);
      EXPECT_LT(amplitude(eccentric, "dmf", centre + side / 7.0), 1e-6 * line);
    }
  }
  EXPECT_EQ(eccentric.mesh_periods, 35.0);
}

// Fewer stiff teeth: the mesh is softer while the damaged tooth is in contact, once per turn.
TEST(FaultyGear, ADamagedToothSoftensItsPairAlone) {
  ModelSetting setting = gear5().default_setting();
  for (const auto& [name, value] :
       {std::pair("zp", 5.0), std::pair("cycle", 5.0), std::pair("damage_p", 0.25)}) {
    set_parameter(&setting, name, value);
  }
  ModelSetting sound = setting;
  set_parameter(&sound, "damage_p", 0.0);
  const auto stiffness = [&](const ModelSetting& of, double mesh_periods) {
    return mesh_at(gear5(), of, mesh_periods / 5.0, mesh_periods / 5.0).stiffness;
  };
  // One pair in contact: that of tooth 0, then that of tooth 1.
  EXPECT_NEAR(stiffness(setting, 0.8), 0.75 * stiffness(sound, 0.8), 1e-15);
  EXPECT_EQ(stiffness(setting, 1.8), stiffness(sound, 1.8));
  EXPECT_LT(stiffness(setting, 1.3), stiffness(sound, 1.3));
  EXPECT_EQ(stiffness(setting, 2.3), stiffness(sound, 2.3));
  EXPECT_EQ(stiffness(setting, 4.9), stiffness(sound, 4.9));
}

// What is refused or not is the same for both engines; this one has nothing to compile.
const std::string kNoDevice = "[integrate]\nengine = 'reference'\nsettle = 1\nrecord = 1\n";

TEST(FaultyGear, ACycleThatDoesNotFitIsRefused) {
  const auto refusal = [](const std::string& parameters,
                          const std::vector<std::string>& overrides = {}) {
    try {
      run(few_teeth(parameters) + kNoDevice, overrides);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  EXPECT_THAT(refusal("runout_p = 0.1\n"),
              HasSubstr("fault of the pinion comes back once per turn: cycle must be a multiple of "
                        "its 5 teeth"));
  EXPECT_THAT(refusal("cycle = 5\ndamage_g = 0.1\n"), HasSubstr("multiple of its 7 teeth"));
  EXPECT_THAT(refusal("cycle = 1.5\n"), HasSubstr("the cycle is 1.5; it must be a whole number"));
  EXPECT_THAT(refusal("cycle = 35\nrunout_p = 0.1\n", {"parameters.zp=5.5"}),
              HasSubstr("whole number of teeth"));
}

TEST(FaultyGear, ASeriesNeedsItsOption) {
  try {
    run(few_teeth("e0 = [0.1, 0.02]\n") + kNoDevice, {"model.error=sine"});
    ADD_FAILURE() << "accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("need the option error = 'series'"));
  }
}

}  // namespace
}  // namespace gearsweep::testing
