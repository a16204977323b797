// gearsweep curves: from a map to its curves, and what it refuses.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "result/border_file.hpp"
#include "support/paused_run.hpp"
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

// What is drawn over a map must be of its plane, in a picture and on the page.
TEST(CurvesCommand, OfAnotherPlaneOrDamagedAreNotDrawn) {
  const Folder folder;
  folder.write("pendulum.toml", kDoublingPendulum);
  const std::string quick = " --set integrate.settle=20 --set integrate.record=20 --quiet";
  ASSERT_EQ(gearsweep(folder, "run pendulum.toml -o map.nc" + quick).status, 0);
  ASSERT_EQ(
      gearsweep(folder, "run pendulum.toml -o other.nc --set parameters.omega=0.7" + quick).status,
      0);
  // Few pixels differ after so short a time: the file has no curve, and is one of curves.
  ASSERT_EQ(gearsweep(folder, "curves map.nc -o curves.nc --quiet --min-pairs 1000").status, 0);
  folder.write("cut.nc", read_all(folder / "curves.nc").substr(0, 9000));
  const auto expect_refused = [&](const std::string& command, const std::string& message) {
    const Outcome outcome = gearsweep(folder, command);
    EXPECT_EQ(outcome.status, 2) << command;
    EXPECT_THAT(outcome.err, HasSubstr(message)) << command;
    EXPECT_EQ(outcome.out, "") << command;
  };
  const std::string plot = "plot other.nc -q period -o map.svg --curves ";
  const std::string other_omega =
      "its curves are of omega = 0.6666666666666666, the map is of omega = 0.7";
  expect_refused(plot + "curves.nc", other_omega);
  expect_refused(plot + "cut.nc", "'cut.nc'");
  const std::string explore = "explore pendulum.toml --no-browser --quiet --curves ";
  expect_refused("explore other.nc --no-browser --curves curves.nc", other_omega);
  expect_refused(explore + "curves.nc --set parameters.omega=0.7", other_omega);
  expect_refused(explore + "curves.nc --set axes.drive.name=phase",
                 "its curves are over damping and drive, the map is over damping and phase");
  expect_refused("explore coarse-map --no-browser --curves curves.nc",
                 "its curves are of the model pendulum, the map is of the model gear5");
  expect_refused(explore + "map.nc", "'map.nc' holds no curves");
  expect_refused(explore + "cut.nc", "'cut.nc'");
  expect_refused(explore + "missing.nc", "missing.nc");
  expect_refused(explore + "pendulum.toml", "'pendulum.toml' is not a NetCDF file");
}

// The places of all curves, curve after curve.
std::vector<std::pair<double, double>> places_in(const std::filesystem::path& file) {
  std::vector<std::pair<double, double>> out;
  for (const StoredCurve& curve : read_borders(file.string()).curves) {
    out.insert(out.end(), curve.places.begin(), curve.places.end());
  }
  return out;
}

constexpr const char* kSearch = "curves map.nc --quiet --min-pairs 3 -o ";

class InterruptedCurves : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_.write("pendulum.toml", kDoublingPendulum);
    ASSERT_EQ(gearsweep(folder_, "run pendulum.toml -o map.nc --quiet").status, 0);
    writes_ = count_writes(folder_, std::string(kSearch) + "whole.nc", ".journal");
    ASSERT_GT(writes_, 10);
  }

  // A search that gets the signal in a write to its journal, with this share of all writes behind
  // it.
  Outcome interrupt(int signal_number, double share) const {
    const long at = static_cast<long>(share * static_cast<double>(writes_));
    PausedRun run(folder_, std::string(kSearch) + "out.nc", ".journal", at);
    EXPECT_TRUE(run.is_paused()) << run.said();
    run.send(signal_number);
    run.go_on();
    const int status = run.end();
    return {status, "", run.said()};
  }

  Folder folder_;
  long writes_ = 0;
};

// Bits, and the words of the summary.
TEST_F(InterruptedCurves, ContinueToTheSameCurvesAfterKills) {
  for (const double share : {0.9, 0.1}) {  // the second search has little left to write
    EXPECT_EQ(interrupt(SIGKILL, share).status, 128 + SIGKILL);
    EXPECT_TRUE(std::filesystem::exists(folder_ / "out.nc.journal"));
  }
  EXPECT_THAT(gearsweep(folder_, "status out.nc").out,
              AllOf(HasSubstr("a search for curves, interrupted"),
                    HasSubstr("to continue: gearsweep curves 'map.nc' --min-pairs 3 -o 'out.nc'")));
  const Outcome rest = gearsweep(folder_, "curves map.nc --min-pairs 3 -o out.nc");
  EXPECT_EQ(rest.status, 0) << rest.err;
  EXPECT_THAT(rest.err, HasSubstr("parts of the search are there from before"));
  EXPECT_EQ(rest.out, gearsweep(folder_, std::string(kSearch) + "again.nc").out);
  EXPECT_EQ(places_in(folder_ / "out.nc"), places_in(folder_ / "whole.nc"));
  EXPECT_EQ(folder_.files(),
            (std::set<std::string>{"again.nc", "map.nc", "out.nc", "pendulum.toml", "whole.nc"}));
}

TEST_F(InterruptedCurves, OtherSettingsAndDamagedJournalsAreRefused) {
  const Outcome stopped = interrupt(SIGINT, 0.9);
  EXPECT_EQ(stopped.status, 130) << stopped.err;
  EXPECT_THAT(stopped.err, HasSubstr("the same command continues"));
  const Outcome other = gearsweep(folder_, "curves map.nc --quiet --min-pairs 4 -o out.nc");
  EXPECT_EQ(other.status, 2);
  EXPECT_THAT(other.err, AllOf(HasSubstr("out.nc.journal"), HasSubstr("borders of 3 pairs"),
                               HasSubstr("--restart")));
  folder_.write("out.nc.journal",
                "no journal at all, of more than a hundred letters, so that it "
                "is longer than the head of a database has to be");
  EXPECT_EQ(gearsweep(folder_, std::string(kSearch) + "out.nc").status, 2);
  EXPECT_EQ(gearsweep(folder_, std::string(kSearch) + "out.nc --restart").status, 0);
  EXPECT_EQ(places_in(folder_ / "out.nc"), places_in(folder_ / "whole.nc"));
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
