// Each model of the zoo has known answers, and one that is wrong is found.
#include "verify/answers.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "study/builtin_models.hpp"
#include "support/run.hpp"

namespace gearsweep::testing {
namespace {

using ::testing::ElementsAre;

std::vector<ComputedAnswer> answers_of(const Model& model) {
  return compute_answers(model, "name = '" + model.name + "'",
                         {[](const Study& study) { return run(study); }});
}

// `gearsweep verify --zoo` computes them (tests/cli/verify_test.cpp).
TEST(Answers, OfEveryModelOfTheZooAreKnown) {
  for (const Model& model : models()) EXPECT_FALSE(model.answers.empty()) << model.name;
}

TEST(Answers, AreEachFoundWrongByTwiceTheTolerance) {
  for (const char* name : {"two_flanks", "duffing_pair"}) {
    Model model = *find_model(name);
    for (KnownAnswer& answer : model.answers) {
      for (double& value : answer.values) value += 2.0 * answer.tolerance + 1e-300;
    }
    for (const ComputedAnswer& one : answers_of(model)) {
      EXPECT_FALSE(one.number.holds()) << name << ' ' << describe(one.number);
    }
  }
}

TEST(Answers, AreInTheOrderOfTheFileAndNameTheirNumbers) {
  Model model = *find_model("hertz");
  std::swap(model.answers.front(), model.answers.back());
  std::vector<std::string> names;
  for (const ComputedAnswer& one : answers_of(model)) {
    names.push_back(one.number.what);
    EXPECT_TRUE(one.number.holds()) << describe(one.number);
  }
  EXPECT_THAT(names, ElementsAre("section_min[1]", "section_min[2]", "section_min[1]",
                                 "section_min[2]", "section_max[1]", "section_max[2]", "x_max",
                                 "section_min[1]", "section_min[2]"));
}

// Without a force, x'' = -x'/10 goes on by 10 v from where it starts. The starts differ in v, the
// first state that `at` names: 0, 0.001 and 0.002.
TEST(Answers, AreTheMeanOverTheirStarts) {
  Model model = *find_model("shaken_pendulum");
  KnownAnswer answer;
  answer.quantity = "x_max";
  answer.at = {{"gravity", 0.0}, {"amplitude", 0.0}, {"v", 0.0}, {"x", 0.5}};
  answer.starts = 3;
  answer.integrate = {{"settle", "200"}, {"record", "1"}};
  answer.values = {0.5 + 0.001 / 0.1};
  answer.tolerance = 1e-9;
  model.answers = {answer};
  EXPECT_TRUE(answers_of(model)[0].number.holds()) << describe(answers_of(model)[0].number);
}

}  // namespace
}  // namespace gearsweep::testing
