#include "plan/shared_steps.hpp"

#include <algorithm>
#include <limits>

namespace gearsweep {
namespace {

constexpr std::size_t kLanes = 4;
// What it takes to make a table, in points that run through it.
constexpr double kCostOfTable = 0.5;

struct Rung {
  std::size_t steps = 0;
  std::size_t points = 0;
};

std::vector<Rung> rungs_of(std::vector<std::size_t> steps) {
  std::ranges::sort(steps);
  std::vector<Rung> rungs;
  for (const std::size_t number : steps) {
    if (rungs.empty() || rungs.back().steps != number) rungs.push_back({number, 0});
    ++rungs.back().points;
  }
  return rungs;
}

double cost_of(std::size_t steps, std::size_t points) {
  const std::size_t lanes = (points + kLanes - 1) / kLanes * kLanes;
  return static_cast<double>(steps) * (static_cast<double>(lanes) + kCostOfTable);
}

}  // namespace

// The cheapest way to cut the rungs into runs, each of which takes its last rung's steps.
SharedSteps::SharedSteps(std::vector<std::size_t> steps) {
  const std::vector<Rung> rungs = rungs_of(std::move(steps));
  struct Best {
    double cost = std::numeric_limits<double>::infinity();
    std::size_t begin = 0;  // of the last run
  };
  std::vector<Best> best(rungs.size() + 1);  // [rungs so far]
  best[0].cost = 0.0;
  for (std::size_t end = 1; end <= rungs.size(); ++end) {
    std::size_t points = 0;
    for (std::size_t begin = end; begin-- > 0;) {
      points += rungs[begin].points;
      const double cost = best[begin].cost + cost_of(rungs[end - 1].steps, points);
      if (cost < best[end].cost) best[end] = {cost, begin};
    }
  }
  for (std::size_t end = rungs.size(); end > 0; end = best[end].begin) {
    chosen_.push_back(rungs[end - 1].steps);
  }
  std::ranges::reverse(chosen_);
}

std::size_t SharedSteps::at_least(std::size_t steps) const {
  const auto found = std::ranges::lower_bound(chosen_, steps);
  return found == chosen_.end() ? steps : *found;
}

}  // namespace gearsweep
