// Without contraction, the kernel and the same headers compiled by the host's compiler give the
// same bits: whatever is wrong with a number, it is not the device's compiler.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "dialect.h"
#include "opencl/opencl_engine.hpp"
#include "plan/plan.hpp"
#include "study/study.hpp"
#include "support/bits.hpp"

namespace gearsweep::fp64 {
using std::sqrt;
using real = double;
using scalar = double;
#include "opencl/host_stepper.h"
}  // namespace gearsweep::fp64

namespace gearsweep::fp32 {
using std::sqrt;  // the one for float too
using real = float;
using scalar = float;
#include "opencl/host_stepper.h"
}  // namespace gearsweep::fp32

namespace gearsweep::testing {
namespace {

struct Laws {
  std::string formulation, backlash, precision;
  std::string centre = "2400";  // A
};

class BitForBit : public ::testing::TestWithParam<Laws> {};

// 1,000 points over 28 periods of at least 44 steps: single-sided, double-sided and chaotic motion,
// several phase grids. As printed, the masses are those of the preset `paper`, lest all diverge.
std::string study_of(const Laws& laws) {
  const std::string masses = laws.formulation == "printed" ? "m1 = 0.0387\nm2 = 0.0387\n" : "";
  return "[model]\npreset = 'coarse'\nformulation = '" + laws.formulation + "'\nbacklash = '" +
         laws.backlash + "'\n[parameters]\nA = " + laws.centre + "\n" + masses +
         "[[axes]]\nname = 'omega'\nfrom = 0.3\nto = 1.6\ncount = 40\n"
         "[[axes]]\nname = 'b'\nfrom = 0.02\nto = 1.5\ncount = 25\n"
         "[initial]\npolicy = 'shifted'\n[integrate]\ncontract = false\nmax_step = 0.1\n"
         "settle = 26\nrecord = 2\nprecision = '" +
         laws.precision + "'\n[observe]\nquantities = ['contact_class']\n";
}

TEST_P(BitForBit, KernelAndHost) {
  const Study study = read_study(study_of(GetParam()), "test.toml");
  const Plan plan(study, 4096);
  ASSERT_EQ(plan.stages().size(), 1U);
  ASSERT_EQ(plan.stages()[0].tiles.size(), 1U);
  const Tile& tile = plan.stages()[0].tiles[0];
  std::vector<double> initial;
  for (const std::size_t point : tile.points) {
    const std::vector<double> own = plan.own_initial_state(point);
    initial.insert(initial.end(), own.begin(), own.end());
  }
  const std::optional<TileResult> kernel =
      make_opencl_engine(study, std::nullopt)
          ->compute(plan, tile, initial, windows_of(study).front(), [](double) { return true; });
  ASSERT_TRUE(kernel);

  const std::size_t periods = study.integrate.settle + study.integrate.record;
  std::vector<double> host;
  std::size_t impacts = 0;
  for (std::size_t i = 0; i < tile.points.size(); ++i) {
    const std::size_t point = tile.points[i];
    const PhaseGrid grid = plan.phase_grid_of(point);
    ASSERT_GE(grid.steps * periods, 1000U);
    const auto step = study.integrate.fp64 ? fp64::step_periods : fp32::step_periods;
    const std::vector<double> state =
        step(plan.setting_of(point), grid, plan.own_initial_state(point), periods,
             study.integrate.events);
    host.insert(host.end(), state.begin(), state.end());
    EXPECT_EQ(kernel->status[i], 0) << "point " << point;
    if (kernel->outputs[4 * tile.points.size() + i] > 0.0) ++impacts;  // contact_class
  }
  EXPECT_EQ(tile.points.size(), 1000U);
  EXPECT_GE(impacts, 500U);
  EXPECT_EQ(different_bits(kernel->final_states, host), 0U);
}

INSTANTIATE_TEST_SUITE_P(
    AllLaws, BitForBit,
    ::testing::Values(Laws{"consistent", "constant", "fp64"}, Laws{"consistent", "dynamic", "fp64"},
                      Laws{"printed", "constant", "fp64"}, Laws{"printed", "dynamic", "fp64"},
                      Laws{"consistent", "constant", "fp32"}, Laws{"consistent", "dynamic", "fp32"},
                      Laws{"printed", "constant", "fp32"}, Laws{"printed", "dynamic", "fp32"},
                      // The shafts move out of the range of the backlash's series and back.
                      Laws{"consistent", "dynamic", "fp64", "60"},
                      Laws{"consistent", "dynamic", "fp32", "60"}),
    [](const auto& laws) {
      return laws.param.formulation + "_" + laws.param.backlash + "_" + laws.param.precision +
             "_A" + laws.param.centre;
    });

}  // namespace
}  // namespace gearsweep::testing
