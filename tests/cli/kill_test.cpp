// kill -9 at any moment leaves no result or a whole one, and the same command goes on to the result
// of an unbroken run. GEARSWEEP_KILLS says how often to kill.
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <random>
#include <thread>

#include "support/process.hpp"
#include "support/same_result.hpp"

namespace gearsweep::testing {
namespace {

using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

// A second or two in 16 tiles of every kind of launch, then a result of 6.5 MB before compression.
const char* const kStudy = R"([model]
preset = "coarse"
[[axes]]
name = "omega"
from = 0.5
to = 1.5
count = 32
[[axes]]
name = "e0"
from = 0.1
to = 0.7
count = 32
[integrate]
settle = 80
record = 200
extend = 1
tile = 64
[observe]
quantities = ["x1_rms", "dmf_max", "contact_class", "period", "lyapunov_max", "poincare"]
poincare = ["x1", "v1", "x2", "v2"]
)";

int chosen_kills() {
  const char* chosen = std::getenv("GEARSWEEP_KILLS");
  return chosen == nullptr ? 6 : std::atoi(chosen);
}

class KillTest : public ::testing::Test {
 protected:
  void SetUp() override { folder_.write("study.toml", kStudy); }

  // A run in the background.
  pid_t start(const std::string& output) {
    abandoned_ = parts();
    const std::string line = "cd '" + folder_.path().string() + "' && exec " +
                             std::string(GEARSWEEP_BINARY) + " run study.toml --quiet -o " + output;
    const pid_t process = fork();
    if (process == 0) {
      execl("/bin/sh", "sh", "-c", line.c_str(), nullptr);
      _exit(127);
    }
    return process;
  }

  // Files that hold part of a result: not the empty one that tries whether one can be written.
  std::set<std::string> parts() const {
    std::set<std::string> names;
    for (const std::string& name : folder_.files()) {
      std::error_code gone;
      if (name.ends_with(".part") && std::filesystem::file_size(folder_ / name, gone) > 0 &&
          !gone) {
        names.insert(name);
      }
    }
    return names;
  }

  // Whether the run that was started last has begun to write its result.
  bool is_writing() const {
    const std::set<std::string> now = parts();
    return !std::includes(abandoned_.begin(), abandoned_.end(), now.begin(), now.end());
  }

  // Until then, or until the process has ended by itself: then its status.
  template <class Condition>
  std::optional<int> wait_until(pid_t process, const Condition& condition) {
    while (!condition()) {
      int status = 0;
      if (waitpid(process, &status, WNOHANG) == process) return status;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return std::nullopt;
  }

  // How long an unbroken run takes, and how long of that it writes its result.
  void measure() {
    const Clock::time_point begin = Clock::now();
    const pid_t process = start("whole.nc");
    ASSERT_FALSE(wait_until(process, [&] { return is_writing(); })) << "no result was written";
    const Clock::time_point write = Clock::now();
    const std::optional<int> status = wait_until(process, [] { return false; });
    ASSERT_EQ(*status, 0);
    whole_ = Clock::now() - begin;
    writing_ = Clock::now() - write;
  }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  void expect_no_result_or_a_whole_one() {
    if (!std::filesystem::exists(folder_ / "out.nc")) return;
    EXPECT_EQ(difference_of_results(path("out.nc"), path("whole.nc")), "");
  }

  Folder folder_;
  std::set<std::string> abandoned_;  // parts that killed runs have left
  Seconds whole_{}, writing_{};
};

TEST_F(KillTest, AKilledRunLeavesNoResultOrAWholeOneAndContinuesToTheSameBits) {
  measure();
  std::mt19937 random(1);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  int killed = 0, killed_in_write = 0;
  while (killed < chosen_kills()) {
    // Twice at any time, once while the result is written; the next run is let go on to its end.
    for (const bool aims_at_write : {false, false, true}) {
      // The first that aims does not wait, so that it cannot come too late.
      const Seconds delay = aims_at_write && killed_in_write == 0
                                ? Seconds(0.0)
                                : share(random) * (aims_at_write ? writing_ : whole_);
      const pid_t process = start("out.nc");
      std::optional<int> ended;
      if (aims_at_write) ended = wait_until(process, [&] { return is_writing(); });
      const Clock::time_point begin = Clock::now();
      if (!ended) ended = wait_until(process, [&] { return Clock::now() - begin >= delay; });
      if (!ended) {
        const bool writes = is_writing();
        kill(process, SIGKILL);
        int status = 0;
        waitpid(process, &status, 0);
        killed += WIFSIGNALED(status) ? 1 : 0;
        killed_in_write += WIFSIGNALED(status) && writes ? 1 : 0;
      }
      expect_no_result_or_a_whole_one();
    }
    EXPECT_EQ(gearsweep(folder_, "run study.toml -o out.nc --quiet").status, 0);
    EXPECT_EQ(difference_of_results(path("out.nc"), path("whole.nc")), "");
    EXPECT_EQ(folder_.files(), (std::set<std::string>{"out.nc", "study.toml", "whole.nc"}));
    std::filesystem::remove(folder_ / "out.nc");
  }
  EXPECT_GT(killed_in_write, 0);
  std::printf("%d kills, %d of them while the result was written\n", killed, killed_in_write);
}

}  // namespace
}  // namespace gearsweep::testing
