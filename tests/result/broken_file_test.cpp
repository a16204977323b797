// Damaged files: whatever the bytes, they are read or refused, and this process goes on.
#include "result/broken_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cerrno>
#include <functional>
#include <random>
#include <string>

#include "engine/trace.hpp"
#include "result/example_result.hpp"
#include "result/trace_file.hpp"

namespace gearsweep::testing {
namespace {

using ::testing::HasSubstr;

// How many of the damaged copies could be read and how many were refused.
struct Fate {
  int read = 0, refused = 0;
};

class BrokenFileTest : public IoTest {
 protected:
  void write_bytes(const std::string& name, const std::string& bytes) const {
    std::ofstream(in_folder(name), std::ios::binary) << bytes;
  }

  // Copies of a file in which 16 bytes in a row are other than they were: at places of this seed,
  // so that a failure comes again. One byte alone is mostly one of the many that nobody reads.
  Fate damage(const std::string& whole, const std::function<void(const std::string&)>& read) const {
    constexpr int kCopies = 200;
    constexpr std::size_t kDamaged = 16;
    std::mt19937 random(20240611);
    Fate fate;
    for (int i = 0; i < kCopies; ++i) {
      std::string bytes = whole;
      const std::size_t place = random() % (bytes.size() - kDamaged);
      for (std::size_t at = place; at < place + kDamaged; ++at) {
        bytes[at] = static_cast<char>(bytes[at] ^ static_cast<char>(1 + random() % 255));
      }
      write_bytes("damaged.nc", bytes);
      SCOPED_TRACE(place);
      try {
        ensure_not_broken(in_folder("damaged.nc"));
        read(in_folder("damaged.nc"));
        ++fate.read;
      } catch (const InputError&) {
        ++fate.refused;
      }
    }
    return fate;
  }
};

void read_map(const std::string& path) {
  read_study_text(path);
  const ResultFile file(path);
  for (const std::string& name : file.quantities()) file.read(name);
}

TEST_F(BrokenFileTest, SoundFilesPass) {
  ensure_not_broken(write(example_result()));
  ensure_not_broken(write(spectrum_result()));
  // More numbers than a block of the first reading holds.
  ensure_not_broken(write(example_result(1000, 500)));
}

TEST_F(BrokenFileTest, WhatIsNoNetcdfFileIsLeftToOthers) {
  write_bytes("study.toml", "[model]\n");
  ensure_not_broken(in_folder("study.toml"));
  ensure_not_broken(in_folder("nothing.nc"));
}

TEST_F(BrokenFileTest, AResultIsReadOrRefusedWhateverItsBytes) {
  const Fate fate = damage(content(write(example_result())), read_map);
  EXPECT_GT(fate.read, 0);
  EXPECT_GT(fate.refused, 0);
}

TEST_F(BrokenFileTest, TracesAreReadOrRefusedWhateverTheirBytes) {
  Trace trace;
  trace.period = 2.5;
  trace.channels = {{"x1", "b_n", "a state"}};
  trace.values.resize(1);
  for (int i = 0; i < 500; ++i) {
    trace.tau.push_back(0.1 * i);
    trace.values[0].push_back(1.0 / (3 * i + 1));
  }
  const Study study = read_study("[[axes]]\nname = 'omega'\nvalues = [0.5]\n", "test");
  write_traces({trace}, {"omega=0.5"}, {}, study, in_folder("traces.nc"), kProvenance);
  const Fate fate = damage(content(in_folder("traces.nc")), [](const std::string& path) {
    if (is_trace_file(path)) read_traces(path);
  });
  EXPECT_GT(fate.read, 0);
  EXPECT_GT(fate.refused, 0);
}

TEST_F(BrokenFileTest, ARefusalNamesTheFileAndLeavesNoProcessBehind) {
  const std::string whole = content(write(example_result()));
  write_bytes("half.nc", whole.substr(0, whole.size() / 2));
  const std::string said = refusal([&] { ensure_not_broken(in_folder("half.nc")); });
  EXPECT_THAT(said, HasSubstr("half.nc"));
  EXPECT_THAT(said, HasSubstr("damaged, or not written by gearsweep"));
  EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1);
  EXPECT_EQ(errno, ECHILD);
}

}  // namespace
}  // namespace gearsweep::testing
