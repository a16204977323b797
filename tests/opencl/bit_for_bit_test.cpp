// Without contraction, the kernel and the same headers compiled by the host's compiler give the
// same bits: whatever is wrong with a number, it is not the device's compiler.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "opencl/opencl_engine.hpp"
#include "plan/plan.hpp"
#include "study/study.hpp"
#include "support/bits.hpp"
#include "verify/detail/host_stepper.hpp"

namespace gearsweep::testing {
namespace {

struct Laws {
  std::string formulation, backlash, precision;
  std::string centre = "2400";  // A
};

class BitForBit : public ::testing::TestWithParam<Laws> {};

// 1,000 points over 28 periods of at least 44 steps: single-sided, double-sided and chaotic motion,
// several phase grids; with dynamic backlash wedged teeth, too. As printed, the masses are those of
// the preset `paper`, lest all diverge.
std::string study_of(const Laws& laws) {
  const std::string masses = laws.formulation == "printed" ? "m1 = 0.0387\nm2 = 0.0387\n" : "";
  return "[model]\npreset = 'coarse'\nformulation = '" + laws.formulation + "'\nbacklash = '" +
         laws.backlash + "'\n[parameters]\nA = " + laws.centre + "\n" + masses +
         "[[axes]]\nname = 'omega'\nfrom = 0.3\nto = 1.6\ncount = 40\n"
         "[[axes]]\nname = 'b'\nfrom = 0.02\nto = 1.5\ncount = 25\n"
         "[initial]\npolicy = 'shifted'\n[integrate]\ncontract = false\nmax_step = 0.1\n"
         "settle = 26\nrecord = 2\nstop = 'never'\nprecision = '" +
         laws.precision + "'\n[observe]\nquantities = ['contact_class']\n";
}

TEST_P(BitForBit, KernelAndHost) {
  const Study study = with_whole_kernel(read_study(study_of(GetParam()), "test.toml"));
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
  std::size_t impacts = 0, wedged = 0;
  for (std::size_t i = 0; i < tile.points.size(); ++i) {
    const std::size_t point = tile.points[i];
    ASSERT_GE(plan.phase_grid_of(point).steps * periods, 1000U);
    const std::vector<double> state = step_on_host(plan, point, periods);
    host.insert(host.end(), state.begin(), state.end());
    EXPECT_EQ(kernel->status[i], 0) << "point " << point;
    const double contact_class = kernel->outputs[5 * tile.points.size() + i];
    if (contact_class > 0.0) ++impacts;
    if (contact_class == 3.0) ++wedged;
  }
  EXPECT_EQ(tile.points.size(), 1000U);
  EXPECT_GE(impacts, 500U);
  EXPECT_EQ(wedged > 5U, GetParam().backlash == "dynamic");
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
