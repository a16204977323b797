// gearsweep trace and reproduce as a user types them.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "support/process.hpp"

namespace gearsweep::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

const char* const kTraceStudy =
    "[model]\npreset = 'coarse'\n[[axes]]\nname = 'omega'\nvalues = [0.6, 0.8, 1.0]\n"
    "[[axes]]\nname = 'b'\nvalues = [0.5, 1.0]\n[integrate]\nsettle = 20\nrecord = 4\n"
    "[observe]\nquantities = ['x1_rms']\n";

// A device's compiler tells a user what it warns of.
TEST(TraceCommand, KernelsOfSurfacesCompileWithoutWarnings) {
  const Folder folder;
  for (const char* const model : {"stribeck", "hard_impact"}) {
    const std::string axis = std::string(model) == "stribeck" ? "belt" : "omega";
    folder.write("study.toml", fmt::format("[model]\nname = '{}'\n[[axes]]\nname = '{}'\n"
                                           "values = [0.3]\n[integrate]\nsettle = 20\n"
                                           "record = 4\n[observe]\n"
                                           "quantities = ['x_max', 'lyapunov_max']\n",
                                           model, axis));
    const Outcome run = gearsweep(folder, "run study.toml -o map.nc");
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_THAT(run.err, Not(HasSubstr("generated"))) << model;
    const Outcome trace = gearsweep(folder, "trace study.toml -o trace.nc");
    EXPECT_EQ(trace.status, 0) << trace.err;
    EXPECT_THAT(trace.err, Not(HasSubstr("generated"))) << model;
  }
}

// The point itself is taken, of a study as of its map.
TEST(TraceCommand, PicksPointsOfStudiesAndMaps) {
  const Folder folder;
  folder.write("study.toml", kTraceStudy);
  ASSERT_EQ(gearsweep(folder, "run study.toml -o map.nc --quiet").status, 0);
  const Outcome map =
      gearsweep(folder,
                "trace map.nc --at omega=0.71,b=0.9 --at omega=1.0,b=0.6 --samples-per-period 8 "
                "-o trace.csv");
  EXPECT_EQ(map.status, 0) << map.err;
  EXPECT_THAT(map.err,
              HasSubstr("omega=0.71, b=0.9 lies between the points of the map; the nearest "
                        "is omega=0.8,b=1\n"));
  EXPECT_THAT(map.err, HasSubstr("omega=0.71, b=0.9: 32 moments of 4 periods after"));
  EXPECT_THAT(map.err, HasSubstr("its spectrum goes up to order 4;"));
  const std::string table = read_all(folder / "trace.csv");
  EXPECT_THAT(table, StartsWith("trace,omega [varpi],b [b_n],tau [1/varpi],x1 [b_n],x2 [b_n],"));
  EXPECT_THAT(table, HasSubstr("\n1,0.71,0.9,0,"));
  EXPECT_THAT(table, HasSubstr("\n2,1,0.6,0,"));
  const Outcome study =
      gearsweep(folder, "trace study.toml --at omega=0.71,b=0.9 --record 1 -o trace.nc");
  EXPECT_EQ(study.status, 0) << study.err;
  EXPECT_THAT(study.err, HasSubstr("omega=0.71, b=0.9: "));
}

TEST(TraceCommand, StartsWhereItIsTold) {
  const Folder folder;
  folder.write("study.toml", kTraceStudy);
  ASSERT_EQ(gearsweep(folder,
                      "trace study.toml --at omega=0.6,b=1,x1=0.25 --settle 0 --record 1 "
                      "-o start.csv --quiet")
                .status,
            0);
  EXPECT_THAT(read_all(folder / "start.csv"), HasSubstr("\n1,0.6,1,0,0.25,"));
}

struct Refusal {
  std::string arguments, message;
};

class TraceRefusal : public ::testing::TestWithParam<Refusal> {};

TEST_P(TraceRefusal, SaysWhatIsWrongAndLeavesNoFile) {
  const Folder folder;
  folder.write("study.toml", kTraceStudy);
  const Outcome outcome = gearsweep(folder, GetParam().arguments);
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr(GetParam().message));
  EXPECT_EQ(folder.files(), std::set<std::string>{"study.toml"});
}

INSTANTIATE_TEST_SUITE_P(
    Cases, TraceRefusal,
    ::testing::Values(
        Refusal{"trace study.toml --at omega=0.7 -o t.nc", "add b=0.5"},
        Refusal{"trace study.toml --at omga=0.7,b=1 -o t.nc", "'omga'"},
        Refusal{"trace study.toml --at omega=fast,b=1 -o t.nc", "'fast' is not a number"},
        Refusal{"trace study.toml --at omega=0.7,b=1 -o t.txt", "must end in .nc or .csv"},
        Refusal{"trace study.toml --at omega=0.7,b=1 -o missing/t.nc", "missing"},
        Refusal{"trace study.toml --at omega=0.7,b=1 -o t.nc --set integrate.tolerance=1e-4",
                "give the finished map (MAP.nc)"},
        Refusal{"reproduce --preset other -o folder", "paper"},
        Refusal{"reproduce -o study.toml", "study.toml"}),
    [](const auto& refusal) { return "number_" + std::to_string(refusal.index); });

TEST(ReproduceCommand, TakesOtherParameters) {
  const Folder folder;
  const Outcome outcome = gearsweep(folder, "reproduce -o folder --set parameters.F9=1");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("F9"));
}

TEST(ReproduceCommand, BringsItsStudies) {
  const Folder folder;
  EXPECT_THAT(gearsweep(folder, "studies paper/fig7").out, HasSubstr("preset = \"paper\""));
  const Outcome run = gearsweep(folder, "run paper/fig5 -o fig5.nc");
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.err, HasSubstr("2 points: ok 2"));
}

}  // namespace
}  // namespace gearsweep::testing
