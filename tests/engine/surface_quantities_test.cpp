// How often a motion meets a surface and how fast, and how long it stays at one. Closed forms stand
// in the files of the zoo.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <string>

#include "study/refusal.hpp"
#include "support/run.hpp"

namespace gearsweep::testing {
namespace {

struct LookedAt {
  const char *model, *axis, *quantities;
  double tolerance;
};

TEST(SurfaceQuantities, AreTheSameInBothEnginesAndInEachLane) {
  const std::string own = "'sticking_share', 'sticking_stops'";
  const std::array cases = {
      LookedAt{"coulomb", "name = 'omega'\nfrom = 0.2\nto = 1.2", "'x_max'", 1e-6},
      LookedAt{"belt", "name = 'w'\nfrom = 0.1\nto = 0.5", "'x_min'", 1e-5},
      LookedAt{"hard_impact", "name = 'x'\nfrom = -0.9\nto = -0.1",
               "'wall_impacts', 'wall_impact_speed'", 1e-6},
  };
  for (const LookedAt& one : cases) {
    SCOPED_TRACE(one.model);
    const std::string study = fmt::format(
        "[model]\nname = '{}'\n[[axes]]\n{}\ncount = 8\n[integrate]\nsettle = 0\nrecord = 4\n"
        "steps_per_period = 256\nstop = 'never'\n[observe]\nquantities = [{}, {}]\n",
        one.model, one.axis, own, one.quantities);
    const SweepResult kernel = run(study, {"integrate.lanes=8"});
    const SweepResult reference = run(study, {"integrate.engine=reference"});
    const SweepResult alone = run(study, {"integrate.lanes=1"});
    for (std::size_t q = 0; q < kernel.values.size(); ++q) {
      for (std::size_t i = 0; i < kernel.status.size(); ++i) {
        EXPECT_NEAR(kernel.values[q][i], reference.values[q][i], one.tolerance) << q;
        EXPECT_EQ(kernel.values[q][i], alone.values[q][i]) << q;
      }
    }
  }
}

// On its orbit a point is recorded for a turn alone.
TEST(SurfaceQuantities, DoNotDependOnHowLongIsRecorded) {
  const std::string study =
      "[model]\nname = 'coulomb'\npreset = 'sticking'\n[[axes]]\nname = 'omega'\nfrom = 0.3\n"
      "to = 0.5\ncount = 4\n[observe]\nquantities = ['sticking_share', 'sticking_stops']\n";
  const SweepResult early = run(study), late = run(study, {"integrate.stop=never"});
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(map_of(early, "sticking_share")[i], map_of(late, "sticking_share")[i], 1e-7);
    EXPECT_NEAR(map_of(early, "sticking_stops")[i], map_of(late, "sticking_stops")[i], 1e-12);
  }
}

TEST(SurfaceQuantities, AreThoseOfModelsThatHaveSome) {
  const auto refused = [](const std::string& model, const std::string& quantity) {
    return refusal(
        fmt::format("[model]\nname = '{}'\n[[axes]]\nname = 'omega'\nfrom = 0.5\nto = 1\n"
                    "count = 4\n[observe]\nquantities = ['{}']\n",
                    model, quantity));
  };
  using ::testing::HasSubstr;
  EXPECT_THAT(refused("duffing", "sticking_share"), HasSubstr("unknown quantity"));
  EXPECT_THAT(refused("coulomb", "wall_impacts"), HasSubstr("unknown quantity"));
  EXPECT_EQ(refused("coulomb", "sticking_stops"), "");
}

}  // namespace
}  // namespace gearsweep::testing
