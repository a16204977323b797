// A signal ends every command at every time, and the command says so.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <optional>
#include <thread>

#include "support/paused_run.hpp"

namespace gearsweep::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

const char* const kSignalsStudy =
    "[model]\npreset = 'coarse'\n[[axes]]\nname = 'omega'\nvalues = [0.6, 0.8]\n"
    "[integrate]\nsettle = 20\nrecord = 4\n[observe]\nquantities = ['x1_rms']\n";

class SignalsTest : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_.write("study.toml", kSignalsStudy);
    std::filesystem::create_directory(folder_ / "tmp");
  }

  // Starts a command that would never end: its driver does not answer. Its temporary files are in
  // tmp/, and its caches cannot be written.
  pid_t start(const std::string& arguments, const std::string& redirection = "2>err") {
    return spawn("exec env LD_PRELOAD=" WAITING_OPENCL
                 " WAITING_FILE=asked TMPDIR=tmp XDG_CACHE_HOME=/proc " GEARSWEEP_BINARY " " +
                 arguments + " " + redirection);
  }

  pid_t spawn(const std::string& command) {
    const std::string line = "cd '" + folder_.path().string() + "' && " + command;
    const pid_t process = fork();
    if (process == 0) {
      execl("/bin/sh", "sh", "-c", line.c_str(), nullptr);
      _exit(127);
    }
    return process;
  }

  static std::optional<int> status_if_ended(pid_t process) {
    int status = 0;
    if (waitpid(process, &status, WNOHANG) != process) return std::nullopt;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }

  // The status, as a shell gives it, of a process that gets the signal until it ends; -1 when it
  // does not.
  static int status_after(pid_t process, int signal_number) {
    constexpr int kPatience = 3000;  // ten minutes: only what never ends takes longer
    for (int i = 0; i < kPatience; ++i) {
      kill(process, signal_number);
      for (int j = 0; j < 20; ++j) {
        if (const std::optional<int> status = status_if_ended(process)) return *status;
        pause_briefly();
      }
    }
    kill(process, SIGKILL);
    waitpid(process, nullptr, 0);
    return -1;
  }

  void wait_for(const std::string& file, pid_t process) {
    while (!std::filesystem::exists(folder_ / file) && kill(process, 0) == 0) pause_briefly();
  }

  static void pause_briefly() { std::this_thread::sleep_for(std::chrono::milliseconds(10)); }

  std::string said() const { return read_all(folder_ / "err"); }

  Folder folder_;
};

// A long trace takes more time to write than to compute.
TEST_F(SignalsTest, EndATraceWhileItIsWritten) {
  PausedRun run(folder_, "trace study.toml --at omega=0.6 -o out.nc", ".part", 1);
  ASSERT_TRUE(run.is_paused()) << run.said();
  run.send(SIGINT);
  EXPECT_EQ(run.end(), 130);
  EXPECT_THAT(run.said(), HasSubstr("gearsweep: interrupted\n"));
}

TEST_F(SignalsTest, EndACommandWhoseDriverDoesNotAnswer) {
  for (const char* command :
       {"devices", "run study.toml -o out.nc", "run study.toml -o out.nc --device 0",
        "run study.toml --dry-run", "trace study.toml --at omega=0.6 -o out.csv",
        "floquet study.toml --at omega=0.6", "verify"}) {
    const pid_t process = start(command);
    wait_for("asked", process);
    EXPECT_EQ(status_after(process, SIGTERM), 130) << command;
    EXPECT_THAT(said(), HasSubstr("gearsweep: interrupted\n")) << command;
    EXPECT_TRUE(std::filesystem::is_empty(folder_ / "tmp")) << command;
    EXPECT_EQ(folder_.files().count("out.nc"), 0U);
    folder_.remove("asked");
  }
}

// One signal is enough, and it leaves nothing behind that a further run would mind.
TEST_F(SignalsTest, TheFirstOneEndsARunWhoseKernelsAreCompiled) {
  for (const char* command :
       {"run study.toml -o out.nc", "trace study.toml --at omega=0.6 -o out.csv"}) {
    const pid_t process =
        spawn("exec env WAITING_IN_BUILD=1 WAITING_FILE=asked LD_PRELOAD=" WAITING_OPENCL
              " TMPDIR=tmp " GEARSWEEP_BINARY " " +
              std::string(command) + " 2>err");
    wait_for("asked", process);
    kill(process, SIGINT);
    std::optional<int> status;
    for (int i = 0; i < 6000 && !(status = status_if_ended(process)); ++i) pause_briefly();
    EXPECT_EQ(status.value_or(-1), 130) << command;
    if (!status) status_after(process, SIGKILL);
    EXPECT_THAT(said(), HasSubstr("gearsweep: interrupted\n")) << command;
    EXPECT_THAT(said(), Not(HasSubstr("finishing"))) << command;
    EXPECT_TRUE(std::filesystem::is_empty(folder_ / "tmp")) << command;
    folder_.remove("asked");
  }
  EXPECT_EQ(gearsweep(folder_, "run study.toml -o out.nc --quiet").status, 0);
}

TEST_F(SignalsTest, ComeFromTheFirstMomentOn) {
  // The program finds it blocked and waiting.
  sigset_t terminate;
  sigemptyset(&terminate);
  sigaddset(&terminate, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &terminate, nullptr);
  const pid_t process = start("devices");
  pthread_sigmask(SIG_UNBLOCK, &terminate, nullptr);
  EXPECT_EQ(status_after(process, SIGTERM), 130);
  EXPECT_EQ(said(), "gearsweep: interrupted\n");
}

TEST_F(SignalsTest, EndAPictureThatIsBeingDrawn) {
  ASSERT_EQ(gearsweep(folder_, "run study.toml -o map.nc --quiet").status, 0);
  std::filesystem::create_directory(folder_ / "bin");
  folder_.write("bin/gnuplot",
                "#!/bin/sh\necho $$ > drawing.new\nmv drawing.new drawing\n"
                "exec sleep 1000\n");
  std::filesystem::permissions(folder_ / "bin/gnuplot", std::filesystem::perms::owner_all);
  for (const int signal_number : {SIGTERM, SIGINT}) {
    const pid_t process =
        spawn("PATH=\"$PWD/bin:$PATH\" exec " GEARSWEEP_BINARY " plot map.nc -o map.png 2>err");
    wait_for("drawing", process);
    EXPECT_EQ(status_after(process, signal_number), 130);
    EXPECT_EQ(said(), "gearsweep: interrupted\n");
    const int drawing = std::stoi(read_all(folder_ / "drawing"));
    EXPECT_THAT(read_all("/proc/" + std::to_string(drawing) + "/status"),
                HasSubstr("SigBlk:\t0000000000000000\n"))
        << "it hears signals, too";
    kill(drawing, SIGTERM);
    folder_.remove("drawing");
  }
}

// The pipe takes no more: what the program would say has to wait, but not what the signal does.
TEST_F(SignalsTest, EndACommandThatNobodyListensTo) {
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  fcntl(ends[1], F_SETFL, O_NONBLOCK);
  const std::string nothing(4096, '\n');
  while (write(ends[1], nothing.data(), nothing.size()) > 0) {
  }
  fcntl(ends[1], F_SETFL, 0);
  ASSERT_EQ(dup2(ends[1], 9), 9);
  const pid_t process = start("run study.toml -o out.nc", "2>&9");
  close(9);
  close(ends[1]);
  wait_for("asked", process);
  EXPECT_EQ(status_after(process, SIGTERM), 130);
  close(ends[0]);
}

}  // namespace
}  // namespace gearsweep::testing
