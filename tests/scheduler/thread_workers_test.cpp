// Workers with engines that compute nothing: who gets which tile, who fails, who stops.
#include "scheduler/thread_workers.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <latch>
#include <memory>
#include <numeric>
#include <thread>
#include <utility>

#include "model/error.hpp"
#include "sweep_types.h"

namespace gearsweep::testing {
namespace {

// Every output of a point is its number in the plan. The first tile waits until every worker
// has one, so that all are at work at once.
class NumberingEngine : public Engine {
 public:
  explicit NumberingEngine(std::latch* all_at_work) : all_at_work_(all_at_work) {}

  EngineInfo info() const override { return {"a counter", "", ""}; }
  std::size_t min_tile() const override { return 1; }
  std::size_t preferred_tile() const override { return 1; }
  std::optional<TileResult> compute(const Plan& plan, const Tile& tile,
                                    const std::vector<double>& initial, const Window& /*window*/,
                                    const RoundCallback& after_round) override {
    if (!std::exchange(has_begun_, true)) all_at_work_->arrive_and_wait();
    if (!work(after_round)) return std::nullopt;
    TileResult result;
    result.status.assign(tile.points.size(), STATUS_ok);
    for (std::size_t i = 0; i < plan.study().selection.output_count(); ++i) {
      result.outputs.insert(result.outputs.end(), tile.points.begin(), tile.points.end());
    }
    result.final_states = initial;
    return result;
  }
  std::optional<std::vector<double>> rows(const Plan& /*plan*/, std::size_t /*point*/,
                                          const std::vector<double>& /*initial*/,
                                          std::size_t /*settle*/, std::size_t /*record*/,
                                          const RoundCallback& /*after_round*/) override {
    return std::nullopt;
  }

 private:
  virtual bool work(const RoundCallback& after_round) { return after_round(1.0); }

  std::latch* all_at_work_;
  bool has_begun_ = false;
};

class BrokenEngine final : public NumberingEngine {
 public:
  using NumberingEngine::NumberingEngine;

 private:
  bool work(const RoundCallback& /*after_round*/) override { throw RunError("it is broken"); }
};

class EndlessEngine final : public NumberingEngine {
 public:
  using NumberingEngine::NumberingEngine;

 private:
  bool work(const RoundCallback& after_round) override {
    while (after_round(1.0)) {
    }
    return false;
  }
};

class ThreadWorkersTest : public ::testing::Test {
 protected:
  static constexpr std::size_t kWorkers = 3, kPoints = 60;
  static constexpr std::chrono::minutes kPatience{10};

  template <typename First>
  ThreadWorkers workers_with() {
    std::vector<std::unique_ptr<Engine>> engines;
    engines.push_back(std::make_unique<First>(&all_at_work_));
    while (engines.size() < kWorkers) {
      engines.push_back(std::make_unique<NumberingEngine>(&all_at_work_));
    }
    return {plan_, std::move(engines), &task_};
  }

  // Hands out all tiles, and again those of workers that fail; what is not a tile's end is left
  // out.
  std::vector<WorkerReport> ends_of_all_tiles(ThreadWorkers* workers) {
    std::vector<std::size_t> waiting(tiles_of(plan_).size());
    std::iota(waiting.begin(), waiting.end(), std::size_t{0});
    std::size_t left = waiting.size();
    std::vector<WorkerReport> ends;
    while (left > 0) {
      for (; !waiting.empty() && workers->idle() > 0; waiting.pop_back()) {
        workers->start(waiting.back(), {});
      }
      std::optional<WorkerReport> report = workers->wait(kPatience);
      if (!report) throw std::logic_error("the workers say nothing any more");
      if (report->kind == WorkerReport::Kind::lost) waiting.push_back(report->tile);
      if (report->kind == WorkerReport::Kind::finished) --left;
      if (report->kind != WorkerReport::Kind::progress) ends.push_back(*std::move(report));
    }
    return ends;
  }

  // Every point of the plan is in one finished tile.
  void expect_all_points(const std::vector<WorkerReport>& ends) {
    std::vector<double> numbers, expected(kPoints);
    for (const WorkerReport& end : ends) {
      const auto points = static_cast<std::ptrdiff_t>(end.result.status.size());
      const auto first = end.result.outputs.begin();
      numbers.insert(numbers.end(), first,
                     first + std::min(points, std::ssize(end.result.outputs)));
    }
    std::sort(numbers.begin(), numbers.end());
    std::iota(expected.begin(), expected.end(), 0.0);
    EXPECT_EQ(numbers, expected);
  }

  const Study study_ = read_study(
      "[[axes]]\nname = 'b'\nfrom = 0.5\nto = 1.5\ncount = 60\n"
      "[observe]\nquantities = ['x1_rms']\n",
      "test");
  const Plan plan_{study_, 2};
  const std::shared_ptr<Scheduler> scheduler_ = std::make_shared<Scheduler>();
  Task task_{scheduler_, 0};
  std::latch all_at_work_{kWorkers};
};

TEST_F(ThreadWorkersTest, EveryMemberWorksAndEveryTileIsComputedOnce) {
  ThreadWorkers workers = workers_with<NumberingEngine>();
  expect_all_points(ends_of_all_tiles(&workers));
  EXPECT_EQ(workers.size(), kWorkers);
  EXPECT_EQ(workers.idle(), kWorkers);
}

TEST_F(ThreadWorkersTest, AMemberThatFailsIsLostAndItsTileCanBeGivenToAnother) {
  ThreadWorkers workers = workers_with<BrokenEngine>();
  const std::vector<WorkerReport> ends = ends_of_all_tiles(&workers);
  expect_all_points(ends);
  EXPECT_EQ(workers.size(), kWorkers - 1);
  EXPECT_EQ(workers.idle(), kWorkers - 1);
  std::size_t lost = 0;
  for (const WorkerReport& end : ends) {
    if (end.kind != WorkerReport::Kind::lost) continue;
    ++lost;
    EXPECT_THROW(std::rethrow_exception(end.failure), RunError);
  }
  EXPECT_EQ(lost, 1U);
}

// Else the results of fast workers would fill the memory while a slow disk stores the first.
TEST_F(ThreadWorkersTest, AMemberIsIdleOnceTheEndOfItsTileIsHeard) {
  std::latch one_at_work{1};
  std::vector<std::unique_ptr<Engine>> engines;
  engines.push_back(std::make_unique<NumberingEngine>(&one_at_work));
  ThreadWorkers workers(plan_, std::move(engines), &task_);
  workers.start(0, {});
  std::optional<WorkerReport> report = workers.wait(kPatience);
  ASSERT_TRUE(report);
  EXPECT_EQ(report->kind, WorkerReport::Kind::progress);
  // The tile ends meanwhile.
  for (int i = 0; i < 200; ++i) {
    EXPECT_EQ(workers.idle(), 0U);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  report = workers.wait(kPatience);
  ASSERT_TRUE(report);
  EXPECT_EQ(report->kind, WorkerReport::Kind::finished);
  EXPECT_EQ(workers.idle(), 1U);
}

TEST_F(ThreadWorkersTest, ARunningTileStopsWhenAskedAndWhenThePoolIsLeft) {
  for (const bool asks : {true, false}) {
    std::latch one_at_work{1};
    std::vector<std::unique_ptr<Engine>> engines;
    engines.push_back(std::make_unique<EndlessEngine>(&one_at_work));
    Task task(scheduler_, 0);
    ThreadWorkers workers(plan_, std::move(engines), &task);
    workers.start(0, {});
    one_at_work.wait();
    if (!asks) continue;  // its end is the test: it would wait for ever
    workers.stop();
    std::optional<WorkerReport> report;
    do {
      report = workers.wait(kPatience);
      ASSERT_TRUE(report);
    } while (report->kind == WorkerReport::Kind::progress);
    EXPECT_EQ(report->kind, WorkerReport::Kind::stopped);
    EXPECT_EQ(workers.idle(), 1U);
  }
}

}  // namespace
}  // namespace gearsweep::testing
