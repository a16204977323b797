// gearsweep curves: from a map to its curves, and what it refuses.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/process.hpp"

namespace gearsweep::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

// The pendulum doubles its period between dampings 0.73 and 0.75.
constexpr const char* kDoublingPendulum = R"(
[model]
name = "pendulum"
[parameters]
omega = 0.6666666666666666
phase = 1.5707963267948966
[[axes]]
name = "damping"
from = 0.73
to = 0.755
count = 16
[[axes]]
name = "drive"
from = 1.49
to = 1.51
count = 16
[integrate]
max_step = 0.1
settle = 2000
[observe]
quantities = ["period"]
)";

TEST(CurvesCommand, FindsTheDoublingOfAPendulumAndDrawsIt) {
  const Folder folder;
  folder.write("pendulum.toml", kDoublingPendulum);
  ASSERT_EQ(gearsweep(folder, "run pendulum.toml -o map.nc --quiet").status, 0);
  const Outcome outcome = gearsweep(folder, "curves map.nc -o curves.nc --quiet --min-pairs 5");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_THAT(
      outcome.out,
      AllOf(HasSubstr("flip of period 1: "), HasSubstr("period 1 | period 2: "),
            HasSubstr("residuals of at most"), HasSubstr("with twice as many curves move by"),
            HasSubstr("what moves the curves across themselves")));
  const Outcome plot = gearsweep(folder, "plot map.nc --curves curves.nc -q period -o map.svg");
  EXPECT_EQ(plot.status, 0) << plot.err;
  EXPECT_THAT(read_all(folder / "map.svg"), HasSubstr("flip"));
  EXPECT_THAT(gearsweep(folder, "plot map.nc --curves map.nc -o m.png").err,
              HasSubstr("'map.nc' holds no curves"));
  const Outcome again = gearsweep(folder, "curves curves.nc -o again.nc");
  EXPECT_EQ(again.status, 2);
  EXPECT_THAT(again.err, HasSubstr("'curves.nc' holds curves already: give the map"));
  EXPECT_THAT(gearsweep(folder, "plot map.nc --curves curves.nc --at drive=1.5 -o m.png").err,
              HasSubstr("--curves takes a map of two axes"));
}

struct WrongCurves {
  const char* study;
  const char* arguments;
  const char* message;
};

class CurvesRefusal : public ::testing::TestWithParam<WrongCurves> {};

TEST_P(CurvesRefusal, SaysWhatIsWrong) {
  const Folder folder;
  folder.write("study.toml", GetParam().study);
  const Outcome run = gearsweep(
      folder,
      "run study.toml -o map.nc --quiet --set integrate.settle=20 --set integrate.record=20");
  ASSERT_EQ(run.status, 0) << run.err;
  const Outcome outcome = gearsweep(folder, GetParam().arguments);
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr(GetParam().message));
  EXPECT_EQ(folder.files(), (std::set<std::string>{"study.toml", "map.nc"}));
}

constexpr const char* kTwoAxes =
    "[model]\nname = \"duffing\"\n[[axes]]\nname = \"omega\"\nfrom = 1\nto = 2\ncount = 3\n"
    "[[axes]]\nname = \"amplitude\"\nfrom = 1\nto = 2\ncount = 3\n";
constexpr const char* kOneValue =
    "[model]\nname = \"duffing\"\n[[axes]]\nname = \"omega\"\nfrom = 1\nto = 2\ncount = 3\n"
    "[[axes]]\nname = \"amplitude\"\nfrom = 1\nto = 1\ncount = 1\n"
    "[observe]\nquantities = [\"period\"]\n";
constexpr const char* kOneAxis =
    "[model]\nname = \"duffing\"\n[[axes]]\nname = \"omega\"\nfrom = 1\nto = 2\ncount = 3\n"
    "[observe]\nquantities = [\"period\"]\n";

INSTANTIATE_TEST_SUITE_P(
    Cases, CurvesRefusal,
    ::testing::Values(WrongCurves{kOneAxis, "curves map.nc -o curves.nc", "no map of two axes"},
                      WrongCurves{kOneValue, "curves map.nc -o curves.nc", "has one value"},
                      WrongCurves{kOneAxis, "curves study.toml -o curves.nc",
                                  "compute the map first"},
                      WrongCurves{kTwoAxes, "curves map.nc -o curves.png", "must end in .nc"},
                      WrongCurves{kTwoAxes, "curves map.nc -o map.nc", "would replace its own"},
                      WrongCurves{kTwoAxes, "curves map.nc -o missing/curves.nc", "missing"},
                      WrongCurves{kTwoAxes, "curves map.nc -o curves.nc", "'period'"}),
    [](const auto& refusal) { return "number_" + std::to_string(refusal.index); });

}  // namespace
}  // namespace gearsweep::testing
