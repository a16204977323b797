// gearsweep bench, as a user runs it, and its reports of numbers that are given. How fast anything
// is is not tested.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/detail/bench_report.hpp"
#include "support/process.hpp"

namespace gearsweep::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

const std::string kBrief = "bench --seconds 1e-6 --repetitions 2 ";

class BenchTest : public ::testing::Test {
 protected:
  void expect_refused(const std::string& arguments, const std::string& words) {
    const Outcome outcome = gearsweep(folder_, "bench " + arguments);
    EXPECT_EQ(outcome.status, 2) << arguments;
    EXPECT_THAT(outcome.err, HasSubstr(words)) << arguments;
    EXPECT_EQ(outcome.out, "") << arguments;
  }

  Folder folder_;
};

TEST_F(BenchTest, WritesATableAndJson) {
  const Outcome outcome = gearsweep(folder_, kBrief + "--only fma/fp32,settle/fp32 --json b.json");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("\nfma/fp32  "), HasSubstr("\nsettle/fp32  "),
                                 HasSubstr("% of the peak\n"), HasSubstr("driver "),
                                 HasSubstr("built with -cl-std=CL1.2"), Not(HasSubstr("map/"))));
  EXPECT_THAT(outcome.err, HasSubstr(": device 0, settle/fp32\n"));
  EXPECT_EQ(folder_.files(), std::set<std::string>{"b.json"});

  const nlohmann::json json = nlohmann::json::parse(read_all(folder_ / "b.json"));
  const nlohmann::json& context = json.at("context");
  for (const char* key : {"date", "host_name", "num_cpus", "mhz_per_cpu", "cpu_scaling_enabled",
                          "library_build_type", "gearsweep_version", "devices"}) {
    EXPECT_TRUE(context.contains(key)) << key;
  }
  EXPECT_NE(context.at("devices").at(0).at("driver"), "");
  const nlohmann::json& benchmarks = json.at("benchmarks");
  ASSERT_FALSE(benchmarks.empty());
  for (const nlohmann::json& one : benchmarks) {
    for (const char* key : {"run_name", "run_type", "cpu_time", "iterations", "repetitions"}) {
      EXPECT_TRUE(one.contains(key)) << key;
    }
    EXPECT_EQ(one.at("time_unit"), "us");
    const bool is_deviation =
        one.value("aggregate_name", "") == "stddev" || one.value("aggregate_name", "") == "cv";
    if (is_deviation) continue;
    EXPECT_GT(one.at("real_time"), 0.0) << one;
    EXPECT_GT(one.at("items_per_second"), 0.0) << one;
  }
  EXPECT_EQ(benchmarks.at(0).at("name"), "fma/fp32");
  EXPECT_EQ(benchmarks.at(0).at("run_type"), "iteration");
  EXPECT_EQ(benchmarks.at(3).at("name"), "fma/fp32_median");
  EXPECT_EQ(benchmarks.at(3).at("run_type"), "aggregate");
}

TEST_F(BenchTest, MeasuresMapsAndTheStart) {
  const Outcome outcome =
      gearsweep(folder_, "bench --repetitions 1 --only map/fp64/stop:never,start");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out,
              AllOf(HasSubstr("points/s"), HasSubstr("% in kernels\n"), HasSubstr("\nstart/cold"),
                    HasSubstr("\nstart/warm"), HasSubstr("one run"), Not(HasSubstr("failed"))));
  EXPECT_EQ(folder_.files(), std::set<std::string>{});
}

TEST_F(BenchTest, SeveralDevicesStandSideBySide) {
  const Outcome outcome =
      run_in(folder_, "POCL_DEVICES='basic pthread' " GEARSWEEP_BINARY " " + kBrief +
                          "--device all --only fma/fp32 --json b.json");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out,
              AllOf(HasSubstr("device 0: "), HasSubstr("device 1: "), HasSubstr("  device 1  ")));
  const std::string text = read_all(folder_ / "b.json");
  EXPECT_THAT(text, AllOf(HasSubstr("\"device:0/fma/fp32\""), HasSubstr("\"device:1/fma/fp32\"")));
}

TEST_F(BenchTest, WrongArgumentsAreRefused) {
  folder_.write("notes.txt", "not to be lost");
  expect_refused("--device 99", "there is no device 99");
  expect_refused("--device 0/1,0/2x", "--device");
  expect_refused("--only settel", "settle, record, map");
  expect_refused("--only ''", "--only");
  expect_refused("--repetitions 0", "'0' is not a whole number from 1");
  expect_refused("--seconds 0", "'0' is not a number greater than 0");
  expect_refused("--seconds fast", "'fast' is not a number greater than 0");
  expect_refused("--json nowhere/b.json", "nowhere");
  expect_refused("--json notes.txt", "exists and is no JSON file");
  expect_refused("--jsn b.json", "did you mean '--json'?");
  EXPECT_EQ(read_all(folder_ / "notes.txt"), "not to be lost");
}

TEST_F(BenchTest, AnInterruptionWritesNothing) {
  // It comes while the first benchmark is measured, which would go on for an hour.
  folder_.write("interrupt", GEARSWEEP_BINARY
                " bench --seconds 3600 --only fma/fp32 --json b.json 2> told &\n"
                "until grep -q fma/fp32 told; do kill -0 $! || exit; sleep 0.05; done\n"
                "kill -TERM $!\n"
                "wait $!\n");
  EXPECT_EQ(run_in(folder_, "bash interrupt").status, 130);
  EXPECT_THAT(read_all(folder_ / "told"), HasSubstr("gearsweep: interrupted\n"));
  EXPECT_EQ(folder_.files(), (std::set<std::string>{"interrupt", "told"}));
}

std::vector<BenchedDevice> given_devices() {
  BenchedDevice first{0, {}, {}};
  first.info.name = "First";
  const Item step = {"step", "steps/s", 1e6};
  first.rows.push_back({"settle/fp32", step, "-DLANES=16", "", false, {}});
  for (const double steps : {2e8, 4e8, 3e8}) {
    first.rows[0].repetitions.push_back(
        {steps, 1.0, 2.0, {{"flop/s", 100.0 * steps}, {"peak_share", 0.5}}});
  }
  first.rows.push_back({"settle/fp64", step, "", "the device has no fp64", false, {}});
  return {first};
}

TEST(BenchReport, TheTableHasMediansSpreadAndReasons) {
  const std::string table = bench_table({}, given_devices());
  EXPECT_THAT(table,
              HasSubstr("settle/fp32  300 M steps/s  66.7 %  30.0 GFLOP/s, 50 % of the peak\n"));
  EXPECT_THAT(table, HasSubstr("settle/fp64  skipped\n"));
  EXPECT_THAT(table, HasSubstr("device 0, skipped: the device has no fp64\n"));
  EXPECT_THAT(table, HasSubstr("device 0: built with -DLANES=16\n"));
}

TEST(BenchReport, TheTimesOfTheJsonAreThoseOfAnIteration) {
  const nlohmann::json json = bench_json({}, given_devices(), "2026-01-31T12:00:00+01:00");
  EXPECT_EQ(json.at("context").at("date"), "2026-01-31T12:00:00+01:00");
  const nlohmann::json& list = json.at("benchmarks");
  ASSERT_EQ(list.size(), 3U + 4U + 1U);
  // A million steps at 2e8 a second.
  EXPECT_DOUBLE_EQ(list.at(0).at("real_time"), 5000.0);
  EXPECT_DOUBLE_EQ(list.at(0).at("cpu_time"), 10000.0);
  EXPECT_EQ(list.at(0).at("iterations"), 200);
  EXPECT_EQ(list.at(2).at("repetition_index"), 2);
  EXPECT_EQ(list.at(4).at("name"), "settle/fp32_median");
  EXPECT_DOUBLE_EQ(list.at(4).at("items_per_second"), 3e8);
  EXPECT_EQ(list.at(7).at("error_message"), "the device has no fp64");
}

}  // namespace
}  // namespace gearsweep::testing
