// What is made of equations, against headers that were written by hand.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "equations/headers.hpp"
#include "expression/periodic_table.hpp"
#include "study/builtin_models.hpp"
#include "study/model_file.hpp"

namespace gearsweep::testing {
namespace {

// Sums are taken in another order: some ten operations of half a unit in the last place each,
// relative to the largest part of the sum.
constexpr double kRounding = 1e-14;
constexpr double kTurn = 2.0 * std::numbers::pi;

std::vector<double> row_of(const Model& model, const ModelSetting& setting, double psi) {
  std::vector<double> row(model.phase_coefs.size());
  model.phase_coefs_at(setting, psi, psi, row.data());
  return row;
}

// A setting with random choices, and parameters within their ranges, of the size of their defaults.
ModelSetting random_setting(const Model& model, std::mt19937_64* random) {
  std::uniform_real_distribution<double> share(-1.0, 1.0);
  ModelSetting setting = model.default_setting();
  for (std::size_t i = 0; i < setting.parameters.size(); ++i) {
    const ParameterInfo& info = model.parameters[i];
    double& value = setting.parameters[i];
    value = value * (1.0 + 0.9 * share(*random)) + (info.min < 0.0 ? 0.3 * share(*random) : 0.0);
    value = std::clamp(value, info.min, info.max);
  }
  for (std::size_t i = 0; i < setting.options.size(); ++i) {
    setting.options[i] = static_cast<int>((*random)() % model.options[i].choices.size());
  }
  return setting;
}

void expect_near(const std::vector<double>& mine, const std::vector<double>& theirs,
                 const std::vector<double>& scales, const std::string& what,
                 double rounding = kRounding) {
  ASSERT_EQ(mine.size(), theirs.size()) << what;
  for (std::size_t i = 0; i < mine.size(); ++i) {
    ASSERT_NEAR(mine[i], theirs[i], rounding * scales[i]) << what << " " << i;
  }
}

// Right-hand side, Jacobian and the signals that both have, at one state and phase.
// rounding: of a number of size 1.
void compare_at(const Model& file, const ModelSetting& own, const Model& header,
                const ModelSetting& theirs, double psi, const std::vector<double>& x,
                double rounding = kRounding) {
  const std::size_t n = x.size();
  const std::vector<double> row = row_of(file, own, psi), their_row = row_of(header, theirs, psi);
  const auto point = file.prepare(own), their_point = header.prepare(theirs);
  ASSERT_DOUBLE_EQ(point->period(), their_point->period());
  std::vector<double> dx(n), their_dx(n), at_rest(n), jacobian(n * n), their_jacobian(n * n);
  point->rhs(row.data(), x.data(), dx.data());
  their_point->rhs(their_row.data(), x.data(), their_dx.data());
  const std::vector<double> zero(n);
  their_point->rhs(their_row.data(), zero.data(), at_rest.data());
  point->jacobian(row.data(), x.data(), jacobian.data());
  their_point->jacobian(their_row.data(), x.data(), their_jacobian.data());
  std::vector<double> parts(n), largest(n * n);
  for (std::size_t i = 0; i < n; ++i) {
    parts[i] = std::fabs(at_rest[i]);
    double most = 1.0;
    for (std::size_t j = 0; j < n; ++j) {
      parts[i] += std::fabs(their_jacobian[i * n + j] * x[j]);
      most = std::max(most, std::fabs(their_jacobian[i * n + j]));
    }
    for (std::size_t j = 0; j < n; ++j) largest[i * n + j] = most;
  }
  for (double& part : parts) part = std::max(part, 1.0);
  expect_near(dx, their_dx, parts, "rhs", rounding);
  expect_near(jacobian, their_jacobian, largest, "jacobian", rounding);
  std::vector<double> signals(file.signals.size()), their_signals(header.signals.size());
  point->signals(row.data(), x.data(), signals.data());
  their_point->signals(their_row.data(), x.data(), their_signals.data());
  // A signal is made of the same parts; an energy has squares of states, which reach 3.
  const double size = 10.0 * std::max(1.0, *std::ranges::max_element(parts));
  for (std::size_t i = 0; i < signals.size(); ++i) {
    if (file.signals[i].is_hidden) continue;  // of its sections
    const int index = header.find_signal(file.signals[i].name);
    ASSERT_GE(index, 0) << file.signals[i].name;
    ASSERT_NEAR(signals[i], their_signals[static_cast<std::size_t>(index)], rounding * size)
        << file.signals[i].name;
  }
}

void compare_contacts_at(const Model& file, const ModelSetting& own, const Model& header,
                         const ModelSetting& theirs, double psi, const std::vector<double>& x) {
  const std::size_t n = x.size();
  const std::vector<double> row = row_of(file, own, psi), their_row = row_of(header, theirs, psi);
  const auto point = file.prepare(own), their_point = header.prepare(theirs);
  ASSERT_EQ(file.contacts.size(), header.contacts.size());
  const std::vector<double> scales(n, 4.0);  // stiffness times masses, and slopes: below 4 in all
  for (std::size_t contact = 0; contact < file.contacts.size(); ++contact) {
    std::vector<double> mine(n), expected(n);
    point->force_direction(contact, row.data(), x.data(), mine.data());
    their_point->force_direction(contact, their_row.data(), x.data(), expected.data());
    expect_near(mine, expected, scales, "force direction");
    for (const double flank : {1.0, -1.0}) {
      point->penetration_gradient({contact, flank}, row.data(), x.data(), mine.data());
      their_point->penetration_gradient({contact, flank}, their_row.data(), x.data(),
                                        expected.data());
      expect_near(mine, expected, scales, "gradient of the penetration");
    }
  }
}

// At 10,000 random settings, phases and states.
void compare(
    const Model& file, const Model& header,
    const std::function<void(ModelSetting*)>& choose = [](ModelSetting*) {}) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> share(-1.0, 1.0);
  for (int i = 0; i < 10000; ++i) {
    ModelSetting theirs = random_setting(header, &random);
    choose(&theirs);
    const ModelSetting own = translated(header, theirs, file);
    std::vector<double> x(header.states.size());
    for (double& state : x) state = 3.0 * share(random);
    const double psi = 0.5 + 0.5 * share(random);
    compare_at(file, own, header, theirs, psi, x);
    compare_contacts_at(file, own, header, theirs, psi, x);
    if (::testing::Test::HasFatalFailure()) return;
  }
}

class Headers : public ::testing::TestWithParam<std::size_t> {
 protected:
  const Model& header() const { return handwritten_models()[GetParam()]; }
};

TEST_P(Headers, AgreeWithTheEquationsWhateverIsSwept) {
  const std::string text = *model_text(header().name);
  // A table without its curve is what both refuse. A gear has a tooth.
  const auto choose = [this](ModelSetting* setting) {
    if (header().name != "gear5") return;
    setting->options[static_cast<std::size_t>(header().find_option("stiffness"))] %= 3;
    const auto value = [&](const char* name) -> double& {
      return setting->parameters[static_cast<std::size_t>(header().find_parameter(name))];
    };
    value("teeth_ratio") = std::max(value("teeth_ratio"), 1.0 / value("zp"));
  };
  compare(*find_model(header().name), header(), choose);
  for (const std::set<std::string>& swept :
       {std::set<std::string>(), std::set{header().parameters.front().name},
        std::set{header().parameters.back().name}}) {
    compare(*read_model_text(text, header().name, swept), header(), choose);
  }
}

TEST_P(Headers, HaveTheSameNamesRangesAndPresets) {
  const Model& file = *find_model(header().name);
  EXPECT_EQ(file.summary, header().summary);
  EXPECT_EQ(file.max_step, header().max_step);
  EXPECT_EQ(file.state_names(), header().state_names());
  EXPECT_EQ(file.angles, header().angles);
  ASSERT_EQ(file.parameters.size(), header().parameters.size());
  for (const ParameterInfo& mine : file.parameters) {
    const int found = header().find_parameter(mine.name);
    ASSERT_GE(found, 0) << mine.name;
    const ParameterInfo& theirs = header().parameters[static_cast<std::size_t>(found)];
    EXPECT_EQ(mine.unit, theirs.unit) << mine.name;
    EXPECT_EQ(mine.default_value, theirs.default_value) << mine.name;
    EXPECT_EQ(mine.min, theirs.min) << mine.name;
    EXPECT_EQ(mine.max, theirs.max) << mine.name;
    const bool is_of_list = mine.meaning.ends_with(")") && !theirs.meaning.ends_with(")");
    if (!is_of_list) {
      EXPECT_EQ(mine.meaning, theirs.meaning) << mine.name;
    }
  }
  for (const ChannelInfo& signal : header().signals) {
    const int found = file.find_signal(signal.name);
    ASSERT_GE(found, 0) << signal.name;
    EXPECT_EQ(file.signals[static_cast<std::size_t>(found)].unit, signal.unit) << signal.name;
  }
  ASSERT_EQ(file.presets.size(), header().presets.size());
  for (std::size_t i = 0; i < file.presets.size(); ++i) {
    EXPECT_EQ(file.presets[i].name, header().presets[i].name);
    EXPECT_EQ(file.presets[i].meaning, header().presets[i].meaning);
  }
}

TEST_P(Headers, RestAndJumpWhereTheEquationsDo) {
  const Model& file = *find_model(header().name);
  std::mt19937_64 random(2);
  for (int i = 0; i < 100; ++i) {
    ModelSetting theirs = random_setting(header(), &random);
    if (const int cycle = header().find_parameter("cycle"); cycle >= 0) {
      theirs.parameters[static_cast<std::size_t>(cycle)] = 1.0;
    }
    const ModelSetting own = translated(header(), theirs, file);
    const std::vector<double> rest = file.equilibrium(own), expected = header().equilibrium(theirs);
    for (std::size_t state = 0; state < rest.size(); ++state) {
      // A root of a difference, as Roessler's, loses a digit.
      EXPECT_NEAR(rest[state], expected[state], 1e-13 * (1.0 + std::fabs(expected[state])));
    }
    const auto phases = [](const Model& model, const ModelSetting& setting) {
      std::vector<double> all = model.break_phases(setting);
      std::ranges::sort(all);
      all.erase(std::unique(all.begin(), all.end()), all.end());
      return all;
    };
    const std::vector<double> jumps = phases(file, own), expected_jumps = phases(header(), theirs);
    ASSERT_EQ(jumps.size(), expected_jumps.size());
    for (std::size_t k = 0; k < jumps.size(); ++k) EXPECT_NEAR(jumps[k], expected_jumps[k], 1e-15);
  }
}

INSTANTIATE_TEST_SUITE_P(All, Headers,
                         ::testing::Range(std::size_t{0}, handwritten_models().size()),
                         [](const auto& model) { return handwritten_models()[model.param].name; });

// The phase of 100 mesh periods is rounded to 1e-13, and curves rise by up to 30 in a radian.
constexpr double kFarRounding = 1e-11;
constexpr double kSamePhase = 1e-9;  // plan/phase_grid.cpp

// A gear pair with whatever faults, errors and curves it may have.
class FaultyGears : public ::testing::Test {
 protected:
  double share() { return std::uniform_real_distribution<double>(0.0, 1.0)(random_); }
  bool coin() { return share() < 0.5; }

  std::shared_ptr<const PeriodicTable> curve(double low, double high, std::size_t points,
                                             Interpolation interpolation) {
    std::vector<TablePoint> table;
    for (std::size_t i = 0; i < points; ++i) {
      const double turn = (static_cast<double>(i) + 0.6 * share()) / static_cast<double>(points);
      table.push_back({kTurn * turn, low + (high - low) * share()});
    }
    return std::make_shared<const PeriodicTable>("curve", table, interpolation);
  }

  // What the model's checks let pass.
  void draw(const Model& header) {
    setting_ = random_setting(header, &random_);
    curves_.clear();
    const auto option = [&](const char* name) -> int& {
      return setting_.options[static_cast<std::size_t>(header.find_option(name))];
    };
    const auto value = [&](const std::string& name) -> double& {
      return setting_.parameters[static_cast<std::size_t>(header.find_parameter(name))];
    };
    value("rho_g") = 1.0 - value("rho_p");
    option("formulation") = 0;
    option("error") = 1;
    value("zp") = 5.0 + std::floor(6.0 * share());
    const double gear = 5.0 + std::floor(6.0 * share());
    value("teeth_ratio") = gear / value("zp");
    value("cycle") = value("zp") * gear;
    for (int n = 2; n <= 8; ++n) {
      value("e0_" + std::to_string(n)) = 0.1 * share();
      value("e0_phase_" + std::to_string(n)) = 6.0 * share();
    }
    for (const char* name : {"kappa_2", "kappa_3", "kappa_4"}) value(name) = 0.1 * share();
    for (const char* name : {"runout_p", "runout_g", "damage_p", "damage_g"}) {
      if (coin()) value(name) = share();
    }
    for (const char* name : {"runout_phase_p", "runout_phase_g"}) value(name) = 6.0 * share();
    if (coin()) value("overlap") = 2.5 * share();
    if (coin()) value("stiffness_factor") = 0.5 + share();
    const bool is_helical = value("overlap") > 0.0;
    if (!is_helical && option("stiffness") < 2 && coin()) value("engagement") = 0.5 * share();
    if (option("stiffness") == 3) {
      curves_["measured_stiffness"] = curve(0.8, 1.2, 7, Interpolation::cubic);
      if (!is_helical && coin()) curves_["load_share"] = curve(0.2, 0.8, 6, Interpolation::linear);
    }
    if (coin()) curves_["torque_swing"] = curve(-0.1, 0.1, 8, Interpolation::cubic);
    for (const std::string side : {"p", "g"}) {
      if (coin()) {
        const auto pitch = curve(-0.1, 0.1, 8, Interpolation::cubic);
        curves_["pitch_" + side] = pitch;
        curves_["pitch_bend_" + side] =
            std::make_shared<const PeriodicTable>(pitch->bend().times(-1.0));
      }
      if (!is_helical && coin()) {
        const std::vector<TablePoint> points = {
            {0.0, 0.1 * share()}, {0.3 * kTurn, share()}, {0.5 * kTurn, share()}};
        curves_["damage_curve_" + side] =
            std::make_shared<const PeriodicTable>("damage", points, Interpolation::linear);
      }
    }
  }

  struct Pair {
    Model header, file;
    ModelSetting own;  // of the file
  };
  Pair plot_pair() {
    const Model& plain = handwritten();
    const Model& text = *find_model("gear5");
    draw(plain);
    const ModelSetting own = translated(plain, setting_, text);
    return {plain.bound({curves_, {}, {}}), text.bound({curves_, own.options, {"omega", "mu"}}),
            own};
  }

  static const Model& handwritten() {
    return *std::ranges::find(handwritten_models(), "gear5", &Model::name);
  }
  double value_of(const std::string& parameter) const {
    return setting_.parameters[static_cast<std::size_t>(handwritten().find_parameter(parameter))];
  }

  std::mt19937_64 random_{5};
  ModelSetting setting_;  // of the header
  Curves curves_;
};

TEST_F(FaultyGears, AreThoseOfTheHeader) {
  for (int i = 0; i < 60; ++i) {
    const Pair pair = plot_pair();
    ASSERT_EQ(pair.header.check(setting_), "") << i;
    ASSERT_EQ(pair.file.check(pair.own), "") << i;
    for (int place = 0; place < 40; ++place) {
      std::vector<double> x(pair.header.states.size());
      for (double& state : x) state = 6.0 * share() - 3.0;
      const double psi = share();
      compare_at(pair.file, pair.own, pair.header, setting_, psi, x, kFarRounding);
      compare_contacts_at(pair.file, pair.own, pair.header, setting_, psi, x);
      if (::testing::Test::HasFatalFailure()) FAIL() << "model " << i << " at " << psi;
    }
  }
}

// The file has further breaks where the second derivative of a pitch error bends: eight in a turn.
TEST_F(FaultyGears, JumpWhereTheHeaderDoes) {
  const auto phases_of = [](const Model& model, const ModelSetting& setting) {
    std::vector<double> all = model.break_phases(setting);
    for (double& phase : all) phase = phase >= 1.0 - kSamePhase ? 0.0 : phase;
    std::ranges::sort(all);
    const auto is_same = [](double one, double next) { return next - one < kSamePhase; };
    all.erase(std::unique(all.begin(), all.end(), is_same), all.end());
    return all;
  };
  for (int i = 0; i < 40; ++i) {
    const Pair pair = plot_pair();
    const std::vector<double> found = phases_of(pair.file, pair.own);
    const std::vector<double> wanted = phases_of(pair.header, setting_);
    for (const double phase : wanted) {
      const auto after = std::ranges::lower_bound(found, phase - kSamePhase);
      EXPECT_TRUE(after != found.end() && *after < phase + kSamePhase) << i << " " << phase;
    }
    const double cycle = value_of("cycle"), teeth = value_of("zp");
    double bends = 0.0;
    if (curves_.contains("torque_swing")) bends += 8.0 * cycle / teeth;
    if (curves_.contains("pitch_p")) bends += 8.0 * cycle / teeth;
    if (curves_.contains("pitch_g")) bends += 8.0 * cycle / (teeth * value_of("teeth_ratio"));
    EXPECT_LE(static_cast<double>(found.size() - wanted.size()), bends + 0.5) << i;
  }
}

}  // namespace
}  // namespace gearsweep::testing
