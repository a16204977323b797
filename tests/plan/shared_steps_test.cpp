// Draws that have phase tables of their own share numbers of steps among the speeds of a study.
#include "plan/shared_steps.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <random>

#include "plan/plan.hpp"
#include "support/settings.hpp"

namespace gearsweep::testing {
namespace {

// What points cost that share these numbers: each takes the smallest that is enough, lanes come by
// fours, and a table takes as long as half a point.
double cost_of(const std::vector<std::size_t>& steps, const std::vector<std::size_t>& chosen) {
  std::map<std::size_t, std::size_t> points;
  for (const std::size_t wanted : steps) ++points[*std::ranges::lower_bound(chosen, wanted)];
  double cost = 0.0;
  for (const auto& [number, count] : points) {
    cost += static_cast<double>(number) * (static_cast<double>((count + 3) / 4 * 4) + 0.5);
  }
  return cost;
}

// Against all the ways that there are.
TEST(SharedSteps, CostTheLeast) {
  std::mt19937 random(7);
  for (int trial = 0; trial < 30; ++trial) {
    std::vector<std::size_t> steps;
    for (int i = 0; i < 25; ++i) steps.push_back(16 + 8 * (random() % 9));
    std::vector<std::size_t> rungs = steps;
    std::ranges::sort(rungs);
    rungs.erase(std::ranges::unique(rungs).begin(), rungs.end());
    const SharedSteps shared(steps);
    std::vector<std::size_t> taken;
    for (const std::size_t rung : rungs) {
      EXPECT_GE(shared.at_least(rung), rung);
      taken.push_back(shared.at_least(rung));
    }
    double least = std::numeric_limits<double>::infinity();
    for (std::uint32_t some = 0; some < 1U << (rungs.size() - 1); ++some) {
      std::vector<std::size_t> chosen;
      for (std::size_t i = 0; i + 1 < rungs.size(); ++i) {
        if (some >> i & 1U) chosen.push_back(rungs[i]);
      }
      chosen.push_back(rungs.back());
      least = std::min(least, cost_of(steps, chosen));
    }
    EXPECT_DOUBLE_EQ(cost_of(steps, taken), least);
  }
}

TEST(SharedSteps, BeyondThemAllANumberIsItsOwn) {
  const SharedSteps shared({32, 40, 40, 64});
  EXPECT_EQ(shared.at_least(65), 65U);
  EXPECT_EQ(SharedSteps().at_least(17), 17U);
}

std::string study_with(const std::string& uncertain) {
  return "[model]\nname = 'gear5'\n[[axes]]\nname = 'omega'\nfrom = 0.1\nto = 1.9\ncount = 40\n"
         "[parameters]\nengagement = 0.1\n[integrate]\nmax_step = 0.2\n"
         "[uncertain]\nsamples = 3\nstart = 'nominal'\n" +
         uncertain;
}

// The teeth's engagement cannot be parted from the phase: so each draw has tables of its own.
TEST(SharedSteps, LeaveFewLanesEmptyWhereEachDrawHasItsOwnTables) {
  const Plan own(
      read_study(study_with("engagement = {distribution = 'uniform', from = 0.08, to = 0.12}\n"),
                 "test.toml"),
      1000);
  const Plan common(
      read_study(study_with("mu = {distribution = 'uniform', from = 0.04, to = 0.06}\n"),
                 "test.toml"),
      1000);
  std::map<std::vector<double>, std::size_t> grids;
  for (std::size_t point = 0; point < 160; ++point) {
    EXPECT_GE(own.steps_of(point), common.steps_of(point)) << "never longer steps";
    ++grids[own.grid_key(point)];
  }
  std::size_t slots = 0;
  for (const auto& [grid, points] : grids) slots += (points + 3) / 4 * 4;
  EXPECT_LE(slots, 160U * 5 / 4);
}

// Draws that share tables need nothing of it: their points have the steps that they ask for.
TEST(SharedSteps, AreNotForDrawsThatHaveTablesInCommon) {
  const std::string drawn = study_with("mu = {distribution = 'uniform', from = 0.04, to = 0.06}\n");
  const Plan with(read_study(drawn, "test.toml"), 1000);
  const Plan without(read_study(drawn.substr(0, drawn.find("[uncertain]")), "test.toml"), 1000);
  for (std::size_t point = 0; point < 40; ++point) {
    EXPECT_EQ(with.steps_of(point), without.steps_of(point));
    EXPECT_EQ(with.steps_of(point + 40), without.steps_of(point));
  }
}

// They are what a study of their parameters gives, to the bit.
TEST(SharedSteps, AreNotForDrawsWithStartsOfTheirOwn) {
  std::string drawn =
      study_with("engagement = {distribution = 'uniform', from = 0.08, to = 0.12}\n");
  drawn.replace(drawn.find("'nominal'"), 9, "'own'");
  const Plan with(read_study(drawn, "test.toml"), 1000);
  const Plan without(read_study(drawn.substr(0, drawn.find("[uncertain]")), "test.toml"), 1000);
  for (std::size_t point = 0; point < 40; ++point) {
    EXPECT_EQ(with.steps_of(point + 40), without.steps_of(point));
  }
}

// What was worked out for one draw's table is of no other.
TEST(PhaseTables, AreTheirOwnDrawsInAnyOrder) {
  Binding binding;
  binding.options = gear5().default_setting().options;
  binding.parameters = {"engagement", "omega", "mu"};
  const Model shared = gear5().bound(binding);
  ModelSetting setting = gear5().default_setting();
  for (const auto& [engagement, eps, mu] : std::vector<std::array<double, 3>>{
           {0.1, 1.6, 0.05}, {0.2, 1.6, 0.02}, {0.1, 1.7, 0.05}, {0.1, 1.6, 0.07}}) {
    set_parameter(&setting, "engagement", engagement);
    set_parameter(&setting, "eps", eps);
    set_parameter(&setting, "mu", mu);
    const Model fresh = gear5().bound(binding);
    EXPECT_EQ(make_phase_grid(shared, setting, 40).coefs,
              make_phase_grid(fresh, setting, 40).coefs);
  }
}

}  // namespace
}  // namespace gearsweep::testing
