// The textbook models against themselves: the exact sums of their exponents, where they rest, each
// model's Jacobian against differences of its right-hand side, the kernel against the reference
// engine. The files of the models have what others published.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "support/each_model.hpp"
#include "support/run.hpp"
#include "support/settings.hpp"
#include "support/study_text.hpp"

namespace gearsweep::testing {
namespace {

// Regular motions of the models that bring their own longest step, beside their presets.
struct RegularMotion {
  std::string name, parameters;
};

class DefaultStep : public ::testing::TestWithParam<RegularMotion> {};

// What Model::max_step says of itself: the exponents of a quarter of it, to a thousandth of the
// largest. With steps of 0.05 each of these is 1.5 to 60 times as far off.
TEST_P(DefaultStep, GivesTheExponentsOfAQuarterOfIt) {
  const auto& [name, parameters] = GetParam();
  const std::string study = "[model]\nname = '" + name + "'\n[parameters]\n" + parameters +
                            "\n[[axes]]\nname = 'x'\nvalues = [-1.9]\n[integrate]\n"
                            "settle = 1000\nstop = 'never'\nextend = 1\n"
                            "[observe]\nquantities = ['lyapunov_spectrum']\n";
  const double quarter = find_model(name)->max_step / 4.0;
  const SweepResult result = run(study);
  const SweepResult finer = run(study, {"integrate.max_step=" + std::to_string(quarter)});
  const std::vector<double>& exponents = map_of(result, "lyapunov_spectrum");
  const std::vector<double>& truth = map_of(finer, "lyapunov_spectrum");
  double max = 0.0;
  for (const double exponent : truth) max = std::max(max, std::abs(exponent));
  for (std::size_t i = 0; i < truth.size(); ++i) {
    EXPECT_NEAR(exponents[i], truth[i], 1e-3 * max) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Textbook, DefaultStep,
    ::testing::Values(RegularMotion{"vanderpol", "mu = 2.2\namplitude = 8.9\nomega = 2.584"},
                      RegularMotion{"vanderpol", "mu = 5.02\namplitude = 3.34\nomega = 1.205"},
                      RegularMotion{"lorenz", "sigma = 18.96\nrho = 29.56\nbeta = 3.412"},
                      RegularMotion{"rossler", "a = 0.1328\nb = 0.3686\nc = 7.424"},
                      RegularMotion{
                          "duffing",
                          "damping = 0.0925\ncubic = 1.23\namplitude = 13.1\nomega = 0.585"}),
    [](const auto& motion) { return motion.param.name + std::to_string(motion.index); });

// A model whose divergence is a constant: the sum of its exponents.
struct Divergence {
  std::string name, model, start;
  double sum;
  const char* coarse;  // a key of [integrate]: steps of 0.01 to 0.06 units of time
  const char* fine;    // of half the length
};

class ExactSum : public ::testing::TestWithParam<Divergence> {};

// What the Runge-Kutta step makes of it is wrong by the fourth power of the step's length: half the
// step must leave a sixteenth. An eighth is what a third order would leave; the next term moves the
// quotient to 9.9 (pendulum) .. 39 (Ueda).
TEST_P(ExactSum, IsReachedWithFourthOrder) {
  const Divergence& row = GetParam();
  const auto error = [&](const char* steps) {
    const SweepResult result = run("[model]\n" + row.model + "\n[[axes]]\n" + row.start +
                                   "count = 64\n[integrate]\nsettle = 200\nrecord = 100\n" + steps +
                                   "\n[observe]\nquantities = ['lyapunov_spectrum']\n");
    double sum = 0.0;
    for (const double exponent : map_of(result, "lyapunov_spectrum")) sum += exponent / 64.0;
    return std::abs(sum - row.sum);
  };
  const double coarse = error(row.coarse);
  // A hundred-thousandth of Lorenz's 13.7, and much less for the others.
  EXPECT_LT(coarse, 1.4e-4);
  EXPECT_LT(error(row.fine), coarse / 8.0);
}

INSTANTIATE_TEST_SUITE_P(
    Textbook, ExactSum,
    ::testing::Values(Divergence{"lorenz", "name = 'lorenz'\npreset = 'classic'",
                                 "name = 'x'\nfrom = 0.0\nto = 0.063\n", -41.0 / 3.0,
                                 "max_step = 0.01", "max_step = 0.005"},
                      Divergence{"ueda", "name = 'duffing'", "name = 'x'\nfrom = 2.5\nto = 2.563\n",
                                 -0.05, "steps_per_period = 160", "steps_per_period = 320"},
                      Divergence{"two_well", "name = 'duffing'\npreset = 'two_well'",
                                 "name = 'x'\nfrom = 0.2\nto = 0.263\n", -0.25,
                                 "steps_per_period = 128", "steps_per_period = 256"},
                      Divergence{"pendulum", "name = 'pendulum'",
                                 "name = 'x'\nfrom = 0.0\nto = 0.063\n", -0.05,
                                 "steps_per_period = 160", "steps_per_period = 320"},
                      Divergence{"duffing_pair", "name = 'duffing_pair'\npreset = 'locked'",
                                 "name = 'x'\nfrom = 2.5\nto = 2.563\n", -4.1,
                                 "steps_per_period = 160", "steps_per_period = 320"},
                      Divergence{"jerk", "name = 'jerk'\npreset = 'classic'",
                                 "name = 'x'\nfrom = 0.0\nto = 0.063\n", -0.6, "max_step = 0.05",
                                 "max_step = 0.025"}),
    [](const auto& row) { return row.param.name; });

// Every model with each combination of its options.
struct ModelChoice {
  const Model* model;
  ModelSetting setting;
};

std::vector<ModelChoice> all_choices() {
  std::vector<ModelChoice> choices;
  for (const Model& model : models()) {
    std::vector<ModelSetting> settings = {model.default_setting()};
    for (std::size_t option = 0; option < model.options.size(); ++option) {
      const std::size_t before = settings.size();
      for (std::size_t choice = 1; choice < model.options[option].choices.size(); ++choice) {
        for (std::size_t i = 0; i < before; ++i) {
          settings.push_back(settings[i]);
          settings.back().options[option] = static_cast<int>(choice);
        }
      }
    }
    for (const ModelSetting& setting : settings) choices.push_back({&model, setting});
  }
  return choices;
}

// Central differences over 2e-5 have errors of 1e-10 |d3f/dx3|/6 and of 1e-11 |f| from rounding,
// some 1e-9 with the coefficients here. The fields' kinks are too rare to lie within a difference.
// The first state spans both flanks and the gap of the gear models; the others stay where gear5's
// dynamic backlash is positive.
TEST(EveryModel, JacobianIsTheDerivativeOfTheRightHandSide) {
  std::uniform_real_distribution<double> anywhere(-1.0, 1.0);
  std::uniform_real_distribution<double> phases(0.0, 1.0);
  for (const ModelChoice& choice : all_choices()) {
    SCOPED_TRACE(choice.model->name);
    std::mt19937 random(1);  // the same places whatever other models there are
    const auto point = choice.model->prepare(choice.setting);
    const std::size_t n = choice.model->states.size();
    double worst = 0.0;
    for (int trial = 0; trial < 100; ++trial) {
      const double psi = phases(random);
      std::vector<double> coefs(choice.model->phase_coefs.size());
      choice.model->phase_coefs_at(choice.setting, psi, psi, coefs.data());
      std::vector<double> x(n);
      for (double& value : x) value = anywhere(random);
      x[0] *= 3.0;
      std::vector<double> jacobian(n * n);
      point->jacobian(coefs.data(), x.data(), jacobian.data());
      for (std::size_t j = 0; j < n; ++j) {
        const double h = 1e-5;
        std::vector<double> left = x, right = x, slope_left(n), slope_right(n);
        left[j] -= h;
        right[j] += h;
        point->rhs(coefs.data(), left.data(), slope_left.data());
        point->rhs(coefs.data(), right.data(), slope_right.data());
        for (std::size_t i = 0; i < n; ++i) {
          const double difference = (slope_right[i] - slope_left[i]) / (2.0 * h);
          // Rounding of a slope grows with it.
          const double size = std::max({1.0, std::abs(slope_left[i]), std::abs(difference)});
          worst = std::max(worst, std::abs(jacobian[i * n + j] - difference) / size);
        }
      }
    }
    EXPECT_LT(worst, 1e-8);
  }
}

// Two periods of the same steps from different starts, by two programs that share the formula
// alone: they round differently, up to 1e-14 for states of size 30 (Lorenz), and in two periods the
// motions separate at most some hundred times (1.3e-12 was found, for van der Pol). Between the
// ends of a step the kernels take the phase from a parabola, so where steps are cut at surfaces the
// engines differ by an error of the steps' own order: 7e-8 with 128 steps, 1.3e-9 with 512
// (rattle). A model without a clock is sampled inside its steps, at a section.
class EachModel : public OfEachModel {};

TEST_P(EachModel, IsTheSameInBothEngines) {
  const Model& model = its_model();
  const bool is_cut = !model.surfaces.empty();
  const double tolerance = model.is_clockless ? 1e-6 : is_cut ? 1e-8 : 1e-11;
  const std::string study =
      "[model]\nname = '" + model.name + "'\n[[axes]]\nname = '" + model.states[0].name +
      "'\nfrom = 0.5\nto = 1.5\ncount = 16\n[integrate]\nsettle = 0\nrecord = 2\n"
      "steps_per_period = " +
      std::string(model.is_clockless ? "2048"
                  : is_cut           ? "512"
                                     : "128") +
      "\nstop = 'never'\n" + observe_all_of(model);
  const SweepResult kernel = run(study);
  const SweepResult reference = run(study, {"integrate.engine=reference"});
  ASSERT_EQ(kernel.samples.size(), reference.samples.size());
  for (std::size_t i = 0; i < kernel.samples.size(); ++i) {
    ASSERT_EQ(std::isnan(kernel.samples[i]), std::isnan(reference.samples[i]));
    if (std::isnan(kernel.samples[i])) continue;
    ASSERT_NEAR(kernel.samples[i], reference.samples[i], tolerance);
  }
}

INSTANTIATE_TEST_SUITE_P(Few, EachModel, ::testing::ValuesIn(few_models()), name_of_model);
INSTANTIATE_TEST_SUITE_P(Others, EachModel, ::testing::ValuesIn(other_models()), name_of_model);

struct Rest {
  const char* model;
  std::vector<std::pair<const char*, double>> changes;  // what must be still
};

// Where policy `shifted` starts, nothing moves when nothing is forced: a few roundings of terms of
// size 30.
TEST(Textbook, RestsAtItsEquilibrium) {
  const std::vector<Rest> rests = {
      {"lorenz", {}},
      {"rossler", {}},
      {"jerk", {}},
      {"duffing", {{"amplitude", 0.0}}},
      {"duffing", {{"amplitude", 0.0}, {"linear", -2.0}}},
      {"pendulum", {{"drive", 0.0}}},
      {"vanderpol", {{"amplitude", 0.0}}},
      {"gear1",
       {{"Fte", 0.0}, {"Fte_2", 0.0}, {"Fte_3", 0.0}, {"k", 0.0}, {"k_2", 0.0}, {"k_3", 0.0}}},
  };
  for (const Rest& rest : rests) {
    SCOPED_TRACE(rest.model);
    const Model& model = *find_model(rest.model);
    ModelSetting setting = model.default_setting();
    for (const auto& [name, value] : rest.changes) {
      setting.parameters[parameter_index(model, name)] = value;
    }
    const std::vector<double> x = model.equilibrium(setting);
    std::vector<double> coefs(model.phase_coefs.size()), slope(x.size());
    model.phase_coefs_at(setting, 0.3, 0.3, coefs.data());
    model.prepare(setting)->rhs(coefs.data(), x.data(), slope.data());
    for (const double value : slope) EXPECT_NEAR(value, 0.0, 1e-13);
  }
}

}  // namespace
}  // namespace gearsweep::testing
