// What is made of equations, against headers that were written by hand.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "equations/headers.hpp"
#include "model/registry.hpp"
#include "study/builtin_models.hpp"
#include "study/model_file.hpp"

namespace gearsweep::testing {
namespace {

// Sums are taken in another order: some ten operations of half a unit in the last place each,
// relative to the largest part of the sum.
constexpr double kRounding = 1e-14;

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

// The header's values, in the order of the file's names.
ModelSetting translated(const Model& header, const ModelSetting& values, const Model& file) {
  ModelSetting setting = file.default_setting();
  for (std::size_t i = 0; i < setting.parameters.size(); ++i) {
    const int index = header.find_parameter(file.parameters[i].name);
    EXPECT_GE(index, 0) << file.parameters[i].name;
    setting.parameters[i] = values.parameters[static_cast<std::size_t>(index)];
  }
  for (std::size_t i = 0; i < setting.options.size(); ++i) {
    const int index = header.find_option(file.options[i].name);
    setting.options[i] = values.options[static_cast<std::size_t>(index)];
  }
  return setting;
}

void expect_near(const std::vector<double>& mine, const std::vector<double>& theirs,
                 const std::vector<double>& scales, const std::string& what) {
  ASSERT_EQ(mine.size(), theirs.size()) << what;
  for (std::size_t i = 0; i < mine.size(); ++i) {
    ASSERT_NEAR(mine[i], theirs[i], kRounding * scales[i]) << what << " " << i;
  }
}

// Right-hand side, Jacobian and the signals that both have, at one state and phase.
void compare_at(const Model& file, const ModelSetting& own, const Model& header,
                const ModelSetting& theirs, double psi, const std::vector<double>& x) {
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
  expect_near(dx, their_dx, parts, "rhs");
  expect_near(jacobian, their_jacobian, largest, "jacobian");
  std::vector<double> signals(file.signals.size()), their_signals(header.signals.size());
  point->signals(row.data(), x.data(), signals.data());
  their_point->signals(their_row.data(), x.data(), their_signals.data());
  // A signal is made of the same parts; an energy has squares of states, which reach 3.
  const double size = 10.0 * std::max(1.0, *std::ranges::max_element(parts));
  for (std::size_t i = 0; i < signals.size(); ++i) {
    const int index = header.find_signal(file.signals[i].name);
    ASSERT_GE(index, 0) << file.signals[i].name;
    ASSERT_NEAR(signals[i], their_signals[static_cast<std::size_t>(index)], kRounding * size)
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
  compare(*find_model(header().name), header());
  for (const std::set<std::string>& swept :
       {std::set<std::string>(), std::set{header().parameters.front().name},
        std::set{header().parameters.back().name}}) {
    compare(*read_model_text(text, header().name, swept), header());
  }
}

TEST_P(Headers, HaveTheSameNamesRangesAndPresets) {
  const Model& file = *find_model(header().name);
  EXPECT_EQ(file.summary, header().summary);
  EXPECT_EQ(file.max_step, header().max_step);
  EXPECT_EQ(file.state_names(), header().state_names());
  EXPECT_EQ(file.angles, header().angles);
  ASSERT_EQ(file.parameters.size(), header().parameters.size());
  for (std::size_t i = 0; i < file.parameters.size(); ++i) {
    const ParameterInfo &mine = file.parameters[i], &theirs = header().parameters[i];
    EXPECT_EQ(mine.name, theirs.name);
    EXPECT_EQ(mine.unit, theirs.unit) << mine.name;
    EXPECT_EQ(mine.default_value, theirs.default_value) << mine.name;
    EXPECT_EQ(mine.min, theirs.min) << mine.name;
    EXPECT_EQ(mine.max, theirs.max) << mine.name;
    EXPECT_EQ(mine.meaning, theirs.meaning) << mine.name;
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
    const ModelSetting theirs = random_setting(header(), &random);
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

// gear5 itself is a header; its equations are an example to change.
TEST(Gear5Equations, AgreeWithTheHeaderOfGear5) {
  const Model& header = *find_model("gear5");
  const auto as_in_the_file = [&](ModelSetting* setting) {
    setting->options.assign(header.options.size(), 0);
    setting->options[static_cast<std::size_t>(header.find_option("backlash"))] = 1;
    const auto value = [&](const char* name) -> double& {
      return setting->parameters[static_cast<std::size_t>(header.find_parameter(name))];
    };
    // The file has no faults of the gears.
    for (const ParameterInfo& info : header.parameters) {
      const bool is_in_file = find_model("gear5_equations")->find_parameter(info.name) >= 0;
      if (!is_in_file) value(info.name.c_str()) = info.default_value;
    }
    value("rho_g") = 1.0 - value("rho_p");
  };
  compare(*find_model("gear5_equations"), header, as_in_the_file);
  compare(*read_model_text(*model_text("gear5_equations"), "", std::set<std::string>{"omega"}),
          header, as_in_the_file);
}

}  // namespace
}  // namespace gearsweep::testing
