// Whose turn it is, and work in the background.
#include "scheduler/scheduler.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <latch>
#include <set>
#include <thread>

#include "scheduler/work.hpp"

namespace gearsweep::testing {
namespace {

class SchedulerTest : public ::testing::Test {
 protected:
  const std::shared_ptr<Scheduler> scheduler_ = std::make_shared<Scheduler>();
};

TEST_F(SchedulerTest, TasksOfOnePriorityComputeBesideEachOther) {
  Task one(scheduler_, 3), other(scheduler_, 3);
  EXPECT_TRUE(one.may_go_on());
  EXPECT_TRUE(other.may_go_on());
}

TEST_F(SchedulerTest, ATaskWaitsWhileOneOfHigherPriorityIsThere) {
  Task low(scheduler_, 0);
  EXPECT_TRUE(low.may_go_on());
  auto high = std::make_unique<Task>(scheduler_, 1);
  EXPECT_TRUE(high->may_go_on());
  std::latch begun{1};
  std::atomic<bool> has_gone_on = false;
  std::jthread thread([&] {
    begun.count_down();
    EXPECT_TRUE(low.may_go_on());
    has_gone_on = true;
  });
  begun.wait();
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  EXPECT_FALSE(has_gone_on);
  high.reset();
  thread.join();
  EXPECT_TRUE(has_gone_on);
}

TEST_F(SchedulerTest, ATaskThatWaitsCanBeCancelled) {
  Task low(scheduler_, 0), high(scheduler_, 1);
  std::jthread thread([&] { EXPECT_FALSE(low.may_go_on()); });
  low.cancel();
  thread.join();
  EXPECT_TRUE(high.may_go_on());
}

// On the reference engine, which computes on the host.
class WorkTest : public SchedulerTest {
 protected:
  static std::shared_ptr<const Plan> plan_of(std::size_t points, std::size_t settle) {
    return std::make_shared<const Plan>(
        read_study(
            "[[axes]]\nname = 'b'\nfrom = 0.5\nto = 1.5\ncount = " + std::to_string(points) +
                "\n[integrate]\nengine = 'reference'\nstop = 'never'\nrecord = 1\nsettle = " +
                std::to_string(settle) + "\n[observe]\nquantities = ['x1_max']\n",
            "test"),
        1);
  }
};

TEST_F(WorkTest, GivesEachTileOnce) {
  std::multiset<std::size_t> tiles;
  Work work(scheduler_, {.plan = plan_of(20, 2),
                         .take = [&](std::size_t tile, const TileResult&) { tiles.insert(tile); }});
  EXPECT_TRUE(work.wait());
  EXPECT_EQ(tiles.size(), 20U);
  EXPECT_EQ(std::set<std::size_t>(tiles.begin(), tiles.end()).size(), 20U);
}

TEST_F(WorkTest, StopsWhenItIsCancelled) {
  std::atomic<std::size_t> taken = 0;
  Work work(scheduler_, {.plan = plan_of(100000, 20), .take = [&](std::size_t, const TileResult&) {
                           if (++taken == 2) work.cancel();
                         }});
  EXPECT_FALSE(work.wait());
  EXPECT_LT(taken, 100000U);
}

TEST_F(WorkTest, TellsWhatItsTakerThrows) {
  Work work(scheduler_, {.plan = plan_of(3, 2), .take = [](std::size_t, const TileResult&) {
                           throw std::runtime_error("the disk is full");
                         }});
  EXPECT_THROW(work.wait(), std::runtime_error);
}

// A tile that is at work finishes its round, and no other one is begun.
TEST_F(WorkTest, WaitsForWorkOfHigherPriority) {
  std::atomic<std::size_t> low_tiles = 0;
  std::latch begun{1};
  Work low(scheduler_, {.plan = plan_of(100000, 20), .take = [&](std::size_t, const TileResult&) {
                          if (++low_tiles == 1) begun.count_down();
                        }});
  begun.wait();
  std::atomic<std::size_t> meanwhile = 0;
  {
    Work high(
        scheduler_,
        {.plan = plan_of(50, 20), .priority = 1, .take = [&](std::size_t tile, const TileResult&) {
           if (tile == 5) meanwhile = low_tiles.load();
         }});
    EXPECT_TRUE(high.wait());
    EXPECT_LE(low_tiles, meanwhile + 1);
  }
  const std::size_t before = low_tiles;
  while (low_tiles < before + 3) std::this_thread::yield();
  low.cancel();
  EXPECT_FALSE(low.wait());
}

TEST(WorkKey, IsMadeOfWhatIsComputed) {
  const auto study = [](const std::string& more) {
    return read_study("[[axes]]\nname = 'b'\nvalues = [0.5, 1.5]\n" + more, "test");
  };
  const std::string key = key_of(Plan(study(""), 2));
  EXPECT_EQ(key_of(Plan(study(""), 2)), key);
  EXPECT_NE(key_of(Plan(study("[integrate]\nmax_step = 0.01\n"), 2)), key);
  EXPECT_NE(key_of(Plan(study("[observe]\nquantities = ['x1_max']\n"), 2)), key);
  EXPECT_NE(key_of(Plan(study(""), 1)), key);
  EXPECT_NE(key_of(Plan(study(""), 2).with_longer_steps()), key);
}

}  // namespace
}  // namespace gearsweep::testing
