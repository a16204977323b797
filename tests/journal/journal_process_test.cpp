// A journal belongs to one run at a time, and what that stored survives kill -9.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "journal/example_journal.hpp"

namespace gearsweep::testing {
namespace {

using JournalProcessTest = JournalTest;
using ::testing::AllOf;
using ::testing::HasSubstr;

TEST_F(JournalProcessTest, ASecondRunOnTheSameOutputIsRefused) {
  Journal first(path_, kSweepA);
  EXPECT_THAT(refusal(), AllOf(HasSubstr(path_), HasSubstr("in use by another run")));
  first.store(0, example_tile(0));
  EXPECT_TRUE(same_bits(*first.find(0), example_tile(0)));
}

TEST_F(JournalProcessTest, TheLockEndsWithTheJournal) {
  { const Journal first(path_, kSweepA); }
  EXPECT_EQ(refusal(), "accepted");
}

TEST_F(JournalProcessTest, ItsStatusCanBeReadWhileARunHoldsIt) {
  Journal journal(path_, kSweepA);
  journal.keep({{"points", "1000"}});
  journal.store(4, example_tile(4, 30));
  journal.store(7, example_tile(7, 20));
  const JournalStatus status = Journal::status(path_);
  EXPECT_TRUE(status.is_held);
  EXPECT_EQ(status.tiles, 2U);
  EXPECT_EQ(status.points, 50U);
  EXPECT_DOUBLE_EQ(status.seconds,
                   example_tile(4, 30).cost.seconds + example_tile(7, 20).cost.seconds);
  EXPECT_THAT(status.devices, ::testing::ElementsAre("device 0", "device 1"));
  EXPECT_EQ(status.notes.at("points"), "1000");
  // Reading it has not let go of the run's lock.
  EXPECT_THAT(refusal(), HasSubstr("in use by another run"));
}

TEST_F(JournalProcessTest, ItsStatusSaysThatNoRunHoldsIt) {
  { Journal(path_, kSweepA).store(0, example_tile(0)); }
  EXPECT_FALSE(Journal::status(path_).is_held);
}

TEST_F(JournalProcessTest, ThreadsMayStoreAtTheSameTime) {
  Journal journal(path_, kSweepA);
  std::vector<std::thread> threads;
  for (std::size_t t = 0; t < 4; ++t) {
    threads.emplace_back([&journal, t] {
      for (std::size_t i = 0; i < 5; ++i) journal.store(5 * t + i, example_tile(5 * t + i));
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (std::size_t i = 0; i < 20; ++i) EXPECT_TRUE(same_bits(*journal.find(i), example_tile(i)));
}

// A child process that stores tiles 0, 1, ... and writes one byte to the pipe for each that it was
// told is durable.
struct Writer {
  pid_t process;
  int acknowledged;  // end of the pipe to read from
};

Writer start_writer(const std::string& path, std::size_t points) {
  int ends[2];
  if (pipe(ends) != 0) throw RunError("no pipe");
  const pid_t process = fork();
  if (process == 0) {
    try {
      Journal journal(path, kSweepA);
      for (std::size_t i = 0;; ++i) {
        journal.store(i, example_tile(i, points));
        if (write(ends[1], "+", 1) != 1) _exit(1);
      }
    } catch (...) {
      _exit(1);
    }
  }
  close(ends[1]);
  return {process, ends[0]};
}

// Waits for `tiles` acknowledgements, kills, and returns how many tiles were acknowledged in all.
std::size_t kill_after(const Writer& writer, std::size_t tiles) {
  std::size_t count = 0;
  char byte = 0;
  while (count < tiles && read(writer.acknowledged, &byte, 1) == 1) ++count;
  kill(writer.process, SIGKILL);
  waitpid(writer.process, nullptr, 0);
  while (read(writer.acknowledged, &byte, 1) == 1) ++count;
  close(writer.acknowledged);
  return count;
}

TEST_F(JournalProcessTest, WhatWasStoredSurvivesKillNine) {
  for (std::size_t trial = 0; trial < 5; ++trial) {
    const std::size_t points = 40 + 400 * trial;
    const Writer writer = start_writer(path_, points);
    const std::size_t stored = kill_after(writer, 3 + 2 * trial);
    ASSERT_GE(stored, 3 + 2 * trial);
    Journal journal(path_, kSweepA);
    // The kill may fall between the commit of one more tile and its acknowledgement.
    EXPECT_GE(journal.finished_tiles(), stored);
    EXPECT_LE(journal.finished_tiles(), stored + 1);
    for (std::size_t i = 0; i < stored; ++i) {
      const std::optional<TileResult> found = journal.find(i);
      EXPECT_TRUE(found && same_bits(*found, example_tile(i, points))) << "tile " << i;
    }
    journal.remove();
    EXPECT_TRUE(folder_is_empty());
  }
}

TEST_F(JournalProcessTest, TheLockOfAnotherProcessEndsWhenItIsKilled) {
  const Writer writer = start_writer(path_, 10);
  char byte = 0;
  EXPECT_EQ(read(writer.acknowledged, &byte, 1), 1);
  EXPECT_THAT(refusal(), HasSubstr("in use by another run"));
  kill_after(writer, 0);
  EXPECT_EQ(refusal(), "accepted");
}

}  // namespace
}  // namespace gearsweep::testing
