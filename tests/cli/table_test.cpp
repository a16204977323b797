// A model that reads a measured curve, from its files to results that need these no more.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/pair_model.hpp"
#include "support/process.hpp"
#include "support/same_result.hpp"

namespace gearsweep::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class TableTest : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string model = pair_model();
    model.replace(model.find("cos(phase)"), 10, "table('mesh.csv', phase, cubic)");
    folder_.write("pair.toml", model);
    folder_.write("mesh.csv", mesh(1.0));
    folder_.write("study.toml",
                  "[model]\nfile = 'pair.toml'\n[[axes]]\nname = 'omega'\nfrom = 0.5\nto = 1.5\n"
                  "count = 40\n[integrate]\nsettle = 50\nrecord = 10\ntile = 8\n"
                  "[observe]\nquantities = ['x_rms', 'dmf_max', 'period']\n");
  }

  static std::string mesh(double amplitude) {
    std::string text = "degree,stiffness\n";
    for (int degree = 0; degree <= 360; degree += 15) {
      text +=
          fmt::format("{},{}\n", degree, amplitude * std::cos(degree * std::numbers::pi / 180.0));
    }
    return text;
  }
  void remove_files() {
    for (const char* name : {"pair.toml", "mesh.csv", "study.toml"}) folder_.remove(name);
  }
  Outcome command(const std::string& words) { return gearsweep(folder_, words); }
  void succeed(const std::string& words) {
    const Outcome outcome = command(words);
    EXPECT_EQ(outcome.status, 0) << words << "\n" << outcome.err;
  }

  Folder folder_;
};

TEST_F(TableTest, TheResultNeedsNoFile) {
  succeed("model pair.toml");
  succeed("run study.toml -o map.nc --quiet");
  for (const char* shard : {"1/2", "2/2"}) {
    succeed(std::string("run study.toml -o part.nc --quiet --shard ") + shard);
  }
  remove_files();
  succeed("merge part.nc.shard-*.journal -o merged.nc --quiet");
  succeed("run map.nc -o again.nc --quiet");
  EXPECT_EQ(difference_of_results(folder_ / "map.nc", folder_ / "again.nc"), "");
  EXPECT_EQ(difference_of_results(folder_ / "map.nc", folder_ / "merged.nc"), "");
  succeed("trace map.nc --at omega=0.8 -o trace.nc --quiet");
  EXPECT_THAT(command("floquet map.nc --at omega=1.4").out, HasSubstr("multipliers"));
  EXPECT_THAT(command("model --study map.nc").out, HasSubstr("gear pair"));
}

TEST_F(TableTest, AChangedTableIsAnotherStudy) {
  succeed("run study.toml -o map.nc --quiet --shard 1/2");
  folder_.write("mesh.csv", mesh(1.01));
  succeed("run study.toml -o map.nc --quiet --shard 2/2");
  const Outcome merged = command("merge map.nc.shard-*.journal -o merged.nc --quiet");
  EXPECT_EQ(merged.status, 2);
  EXPECT_THAT(merged.err, HasSubstr("study"));
}

TEST_F(TableTest, AMistakeIsToldWithItsPlace) {
  folder_.write("mesh.csv", "degree,stiffness\n0,1\n180;nothing\n");
  for (const char* words : {"run study.toml -o map.nc", "model pair.toml"}) {
    const Outcome outcome = command(words);
    EXPECT_EQ(outcome.status, 2);
    EXPECT_THAT(outcome.err, AllOf(HasSubstr("pair.toml:19:26: "),
                                   HasSubstr("mesh.csv:3: 'nothing' is not a number")));
  }
  folder_.remove("mesh.csv");
  EXPECT_THAT(command("run study.toml -o map.nc").err,
              HasSubstr("mesh.csv: there is no such file"));
}

}  // namespace
}  // namespace gearsweep::testing
