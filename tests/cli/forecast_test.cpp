// What a dry run tells, against what a run then takes; and what a device's memory allows.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "support/process.hpp"
#include "support/same_result.hpp"
#include "support/study_text.hpp"

namespace gearsweep::testing {
namespace {

using ::testing::HasSubstr;

// Chaotic from everywhere, so that its samples can hardly be compressed.
const char* const kChaos = R"([model]
name = "lorenz"
[[axes]]
name = "x"
from = -5.0
to = 5.0
count = 2048
[integrate]
settle = 20
record = 200
stop = "never"
[observe]
quantities = ["x_rms", "poincare"]
)";

// A large map of next to no work: memory is all that it takes.
const std::string kLarge = coarse_study(640, 640, R"([integrate]
steps_per_period = 16
settle = 1
record = 2
stop = "never"
[observe]
quantities = ["x1_rms", "dmf_max", "contact_class", "x1_max", "v1_max", "poincare"]
poincare = ["x1", "v1"]
)");

// All kinds of launches.
const std::string kOrbits = coarse_study(64, 32, R"([integrate]
settle = 150
record = 50
extend = 2
tile = 2048
[observe]
quantities = ["x1_rms", "period", "lyapunov_max", "poincare"]
)");

class ForecastTest : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_.write("chaos.toml", kChaos);
    folder_.write("large.toml", kLarge);
    folder_.write("orbits.toml", kOrbits);
  }

  nlohmann::json forecast(const std::string& study) {
    const Outcome outcome = gearsweep(folder_, "run " + study + " --dry-run --json");
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return nlohmann::json::parse(outcome.out);
  }

  // Runs a study; the largest memory that the process had, in bytes.
  double memory_of(const std::string& study) {
    const std::string line = "cd '" + folder_.path().string() + "' && exec " +
                             std::string(GEARSWEEP_BINARY) + " run " + study + " --quiet -o out.nc";
    const pid_t process = fork();
    if (process == 0) {
      execl("/bin/sh", "sh", "-c", line.c_str(), nullptr);
      _exit(127);
    }
    int status = 0;
    struct rusage usage = {};
    wait4(process, &status, 0, &usage);
    EXPECT_EQ(status, 0);
    return 1024.0 * static_cast<double>(usage.ru_maxrss);
  }

  // Bytes in buffers at a time, and in the largest of them, of a run.
  std::pair<double, double> buffers_of(const std::string& study, const std::string& more = "") {
    const Outcome outcome = run_in(folder_, more +
                                                " COUNTED_BYTES=counted LD_PRELOAD=" COUNTING_OPENCL
                                                " " GEARSWEEP_BINARY " run " +
                                                study + " --quiet -o out.nc");
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    std::istringstream counted(read_all(folder_ / "counted"));
    std::pair<double, double> bytes;
    counted >> bytes.first >> bytes.second;
    EXPECT_GT(bytes.second, 0.0);
    return bytes;
  }

  Folder folder_;
};

TEST_F(ForecastTest, ADryRunTellsAndWritesNothing) {
  const std::set<std::string> before = folder_.files();
  const Outcome outcome = gearsweep(folder_, "run orbits.toml --dry-run");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  for (const char* word : {"2048 points; 1 tile", "time", "memory", "device", "disk"}) {
    EXPECT_THAT(outcome.out, HasSubstr(word));
  }
  const nlohmann::json json = forecast("orbits.toml");
  EXPECT_EQ(json["points"], 2048);
  EXPECT_GT(json["seconds"], 0.0);
  EXPECT_EQ(folder_.files(), before);
}

TEST_F(ForecastTest, TheFilesAreAsLargeAsTold) {
  const nlohmann::json json = forecast("chaos.toml");
  ASSERT_EQ(gearsweep(folder_, "run chaos.toml -o out.nc --quiet --keep-journal").status, 0);
  const auto size = [&](const char* name) {
    return static_cast<double>(std::filesystem::file_size(folder_ / name));
  };
  // The sign and the exponent of a number of known magnitude compress: a byte and a half of eight.
  EXPECT_LE(size("out.nc"), json["result_bytes"]);
  EXPECT_GE(size("out.nc"), 0.75 * json["result_bytes"].get<double>());
  // The last page of each blob is half empty on average, and counted as if it were all empty.
  EXPECT_LE(size("out.nc.journal"), json["journal_bytes"]);
  EXPECT_GE(size("out.nc.journal"), 0.9 * json["journal_bytes"].get<double>());
}

TEST_F(ForecastTest, AMapTakesNoMoreMemoryThanTold) {
  // The driver's compiler takes more than a small map; what it has compiled, it keeps.
  memory_of("large.toml");
  const double base = memory_of("large.toml --set axes.e0.count=8");
  const nlohmann::json json = forecast("large.toml");
  const double told =
      json["memory_bytes"].get<double>() - json["memory_bytes_of_program"].get<double>();
  // The bound has room for the worst: lists that have just doubled, caches that are full. On a busy
  // machine the two tiles that are computed at a time may miss each other.
  double growth = 0.0;
  for (int run = 0; run < 8 && growth < 0.4 * told; ++run) {
    growth = std::max(growth, memory_of("large.toml") - base);
  }
  EXPECT_LE(growth, told);
  EXPECT_GE(growth, 0.4 * told);
  EXPECT_LE(base, json["memory_bytes_of_program"]);
}

TEST_F(ForecastTest, BuffersTakeNoMoreThanTold) {
  // When every point runs to its end, all is known before. How many points try an orbit at a time,
  // and how long the orbits are, is not: were it all of them, and the longest, in both tiles that
  // are computed at a time, it would be seven times as much as here.
  for (const auto& [study, min] : {std::pair{"chaos.toml", 0.95}, std::pair{"large.toml", 0.95},
                                   std::pair{"orbits.toml", 0.1}}) {
    const nlohmann::json device = forecast(study)["devices"][0];
    const double enough = min * device["tile_bytes"].get<double>();
    double most = 0.0;
    // On a busy machine the two tiles may miss each other.
    for (int run = 0; run < 8 && most < enough; ++run) {
      const auto [all, largest] = buffers_of(study);
      EXPECT_LE(all, device["tile_bytes"]) << study;
      EXPECT_LE(largest, device["tile_bytes_of_largest_buffer"]) << study;
      most = std::max(most, all);
    }
    EXPECT_GE(most, enough) << study;
  }
}

TEST_F(ForecastTest, TilesAreCutToFitTheDevice) {
  ASSERT_EQ(gearsweep(folder_, "run orbits.toml -o whole.nc --quiet").status, 0);
  const double memory = 800e3;
  const auto [all, largest] = buffers_of("orbits.toml", "DEVICE_MEMORY=800000");
  // Some room is left to the driver; a single buffer may have a quarter of the memory. What is left
  // beyond that is for more and longer orbits than there are here.
  EXPECT_LE(all, 0.75 * memory);
  EXPECT_LE(largest, 0.25 * memory);
  EXPECT_GE(std::max(all / 0.75, largest / 0.25), 0.25 * memory);
  EXPECT_EQ(difference_of_results(folder_ / "out.nc", folder_ / "whole.nc"), "");
}

TEST_F(ForecastTest, ADeviceWithoutRoomForAPointIsRefused) {
  const Outcome outcome = run_in(folder_, "DEVICE_MEMORY=4000 LD_PRELOAD=" COUNTING_OPENCL
                                          " " GEARSWEEP_BINARY " run chaos.toml -o out.nc");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("a tile of a single point does not fit the devices"));
  EXPECT_THAT(outcome.err, HasSubstr("of 4.0 kB"));
  EXPECT_EQ(folder_.files().count("out.nc.journal"), 0U);
}

TEST_F(ForecastTest, AStudyBeyondTheMemoryIsRefusedWithTheNumbers) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the sanitizer takes more address space than the limit";
#endif
  const Outcome outcome =
      run_in(folder_, "sh -c 'ulimit -v 4000000; exec " GEARSWEEP_BINARY
                      " run large.toml -o out.nc --set axes.omega.count=8000 --set "
                      "axes.e0.count=8000'");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("the study needs up to"));
  EXPECT_THAT(outcome.err, HasSubstr("of memory"));
  EXPECT_EQ(folder_.files(), (std::set<std::string>{"chaos.toml", "large.toml", "orbits.toml"}));
}

}  // namespace
}  // namespace gearsweep::testing
