// gear5's contact force f = max(D - b', 0) + min(D + b', 0) for any deflection D and working
// backlash b', negative ones included.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "support/settings.hpp"

namespace gearsweep::testing {
namespace {

struct Contact {
  double D, b, f;
};

class Force : public ::testing::TestWithParam<std::string> {
 protected:
  Force() : setting_(gear5().default_setting()) {
    set_option(&setting_, "backlash", "dynamic");
    set_option(&setting_, "formulation", GetParam());
    set_parameter(&setting_, "mu", 0.0);  // so that the meshing force is B f
    coefs_.resize(gear5().phase_coefs.size());
    gear5().phase_coefs_at(setting_, 0.3, 0.3, coefs_.data());
  }

  // A point of its own for each trial: shafts apart and together, backlash and centre distance
  // small and large.
  void plot_point() {
    set_parameter(&setting_, "b", std::pow(10.0, -2.0 + 2.0 * uniform_(random_)));
    set_parameter(&setting_, "A", std::pow(10.0, 1.0 + 3.0 * uniform_(random_)));
    point_ = gear5().prepare(setting_);
    state_.assign(gear5().states.size(), 0.0);
    for (std::size_t i = 1; i < 5; ++i) state_[i] = 2.0 * uniform_(random_) - 1.0;
  }

  // What the model makes of the drawn shafts where the deflection is D.
  Contact at(double D) const {
    std::vector<double> x = state_;
    const double sign = GetParam() == "printed" ? 1.0 : -1.0;
    x[0] = D - sign * (x[2] - x[4]);
    std::vector<double> signals(gear5().signals.size());
    point_->signals(coefs_.data(), x.data(), signals.data());
    const auto signal = [&](const char* name) { return signals[signal_index(gear5(), name)]; };
    return {signal("deflection"), signal("backlash"), signal("dmf") / signal("mesh_stiffness")};
  }

  double plot_deflection() { return 3.0 * (2.0 * uniform_(random_) - 1.0); }

  std::mt19937 random_{5};
  std::uniform_real_distribution<double> uniform_{0.0, 1.0};
  ModelSetting setting_;
  std::vector<double> coefs_, state_;
  std::unique_ptr<PreparedPoint> point_;
};

constexpr int kTrials = 20000;
// A few roundings of numbers below 4.
constexpr double kRounding = 4e-15;

TEST_P(Force, IsWhatBothFlanksGive) {
  int gaps = 0, wedged = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    plot_point();
    const Contact c = at(plot_deflection());
    ASSERT_NEAR(c.f, std::max(c.D - c.b, 0.0) + std::min(c.D + c.b, 0.0), kRounding)
        << "D " << c.D << ", b' " << c.b;
    if (std::abs(c.D) < c.b) ++gaps;
    if (std::abs(c.D) < -c.b) ++wedged;
  }
  EXPECT_GT(gaps, 500);
  EXPECT_GT(wedged, 300);
}

TEST_P(Force, IsOdd) {
  for (int trial = 0; trial < kTrials; ++trial) {
    plot_point();
    const double D = plot_deflection();
    ASSERT_NEAR(at(D).f, -at(-D).f, kRounding) << "D " << D << ", b' " << at(D).b;
  }
}

// Its slope is at most 2 along D and 1 along b'. Neighbours on either side of each edge, moved by
// the shafts too, so that b' changes: no jump anywhere, at b' = 0 neither.
TEST_P(Force, IsContinuousInDeflectionAndBacklash) {
  for (int trial = 0; trial < kTrials; ++trial) {
    plot_point();
    const double b = at(0.0).b;
    const double edges[] = {b, -b, 0.0, plot_deflection()};
    const double D = edges[trial % 4];
    const Contact here = at(D);
    state_[3] += trial % 8 < 4 ? 1e-6 : -1e-6;
    for (const double step : {-1e-6, 0.0, 1e-6}) {
      const Contact there = at(D + step);
      ASSERT_LE(std::abs(there.f - here.f),
                2.0 * std::abs(there.D - here.D) + std::abs(there.b - here.b) + kRounding)
          << "D " << D << ", b' " << b;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(BothFormulations, Force, ::testing::Values("consistent", "printed"),
                         [](const auto& formulation) { return formulation.param; });

}  // namespace
}  // namespace gearsweep::testing
