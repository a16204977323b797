// Queries of several threads become batches, and each thread gets its own answers.
#include "borders/joined_orbit_map.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <latch>
#include <stdexcept>
#include <thread>

namespace gearsweep::testing {
namespace {

// Answers with the query's own value; counts the batches, and fails in one of them.
class Echo final : public OrbitMap {
 public:
  explicit Echo(int failing = -1) : failing_(failing) {}
  std::vector<std::optional<OrbitAnswer>> answer(const std::vector<OrbitQuery>& queries) override {
    if (batches++ == failing_) throw std::runtime_error("the device is gone");
    std::vector<std::optional<OrbitAnswer>> out;
    for (const OrbitQuery& query : queries) {
      out.push_back(OrbitAnswer{Eigen::VectorXd::Constant(1, query.values[0]), {}});
    }
    return out;
  }
  std::atomic<int> batches = 0;

 private:
  const int failing_;
};

OrbitQuery query_of(double value) { return {{value}, Eigen::VectorXd::Zero(1), 1}; }

TEST(JoinedOrbitMap, GivesEachThreadItsOwnAnswers) {
  Echo echo;
  JoinedOrbitMap joined(&echo);
  constexpr int kThreads = 6, kRounds = 200;
  std::atomic<int> wrong = 0;
  std::latch all_are_members(kThreads);
  {
    std::vector<std::jthread> threads;
    for (int i = 0; i < kThreads; ++i) {
      threads.emplace_back([&, i] {
        const JoinedOrbitMap::Member member(&joined);
        all_are_members.arrive_and_wait();
        // Threads end after different numbers of rounds, and of queries in each.
        for (int round = 0; round < kRounds * (i + 1) / kThreads; ++round) {
          std::vector<OrbitQuery> queries;
          for (int k = 0; k <= i; ++k) queries.push_back(query_of(1000.0 * i + round + 0.1 * k));
          const auto answers = joined.answer(queries);
          for (int k = 0; k <= i; ++k) {
            const auto& answer = answers[static_cast<std::size_t>(k)];
            if (answer->image[0] != 1000.0 * i + round + 0.1 * k) ++wrong;
          }
        }
      });
    }
  }
  EXPECT_EQ(wrong, 0);
  // The thread that asks most often takes part in each batch.
  EXPECT_EQ(echo.batches, kRounds);
}

TEST(JoinedOrbitMap, AFailureReachesEachThreadThatWaits) {
  Echo echo(0);
  JoinedOrbitMap joined(&echo);
  std::atomic<int> failed = 0, answered = 0;
  std::latch all_are_members(4);
  {
    std::vector<std::jthread> threads;
    for (int i = 0; i < 4; ++i) {
      threads.emplace_back([&] {
        const JoinedOrbitMap::Member member(&joined);
        all_are_members.arrive_and_wait();
        try {
          joined.answer({query_of(1.0)});
          ++answered;
        } catch (const std::runtime_error&) {
          ++failed;
        }
      });
    }
  }
  EXPECT_EQ(failed, 4);
  EXPECT_EQ(answered, 0);
}

}  // namespace
}  // namespace gearsweep::testing
