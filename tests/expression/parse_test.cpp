// The grammar of expressions, and what is said where a text does not keep it.
#include "expression/parse.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "expression/print.hpp"
#include "expression/tape.hpp"

namespace gearsweep::testing {
namespace {

using ::testing::HasSubstr;

// Names and their values.
const std::map<std::string, double> kValues = {{"x", 3.0}, {"zeta", 0.25}, {"b", 1.0}};

NodeId parse(const std::string& text, ExpressionGraph* graph) {
  const ExpressionNames names = {.find = [&](const std::string& name) -> std::optional<NodeId> {
                                   if (!kValues.contains(name)) return std::nullopt;
                                   return graph->symbol(name);
                                 },
                                 .known =
                                     [] {
                                       std::vector<std::string> known;
                                       for (const auto& [name, value] : kValues)
                                         known.push_back(name);
                                       return known;
                                     }};
  return parse_expression(text, names, graph);
}

double value_of(const std::string& text) {
  ExpressionGraph graph;
  const NodeId root = parse(text, &graph);
  std::vector<NodeId> symbols;
  std::vector<double> values;
  for (const auto& [name, value] : kValues) {
    symbols.push_back(graph.symbol(name));
    values.push_back(value);
  }
  return Tape(graph, symbols, {root}).run(values);
}

// Where the text is refused, and why.
ExpressionError error_of(const std::string& text) {
  ExpressionGraph graph;
  try {
    parse(text, &graph);
  } catch (const ExpressionError& error) {
    return error;
  }
  return {0, "no error"};
}

TEST(Grammar, BindsAsInMathematics) {
  EXPECT_EQ(value_of("1 + 2*3"), 7.0);
  EXPECT_EQ(value_of("(1 + 2)*3"), 9.0);
  EXPECT_EQ(value_of("2 - 3 - 4"), -5.0);
  EXPECT_EQ(value_of("12/3/2"), 2.0);
  EXPECT_EQ(value_of("-x^2"), -9.0);
  EXPECT_EQ(value_of("2^-2"), 0.25);
  EXPECT_EQ(value_of("2^3^2"), 512.0);
  EXPECT_EQ(value_of("2**3*2"), 16.0);
  EXPECT_EQ(value_of("- -x"), 3.0);
  EXPECT_EQ(value_of("2*-x"), -6.0);
  EXPECT_EQ(value_of(".5e1 + 1."), 6.0);
}

TEST(Grammar, HasTheUsualFunctions) {
  EXPECT_EQ(value_of("sin(x) + cos(x)*tan(x)"), std::sin(3.0) + std::cos(3.0) * std::tan(3.0));
  EXPECT_EQ(value_of("atan2(x, b)"), std::atan2(3.0, 1.0));
  EXPECT_EQ(value_of("clamp(x, -b, b) + 10*clamp(-x, -b, b) + 100*clamp(0.5, -b, b)"), 41.0);
  EXPECT_EQ(value_of("step(x) + 10*step(0) + 100*step(-x)"), 11.0);
  EXPECT_EQ(value_of("sign(-x) + floor(zeta) + abs(-x)"), 2.0);
  EXPECT_EQ(value_of("cos(pi)"), std::cos(std::numbers::pi));
}

TEST(Grammar, HasTheForcesOfContacts) {
  EXPECT_EQ(value_of("backlash(x, b)"), 2.0);
  EXPECT_EQ(value_of("backlash(-x, b)"), -2.0);
  EXPECT_EQ(value_of("backlash(zeta, b)"), 0.0);
  EXPECT_EQ(value_of("stop(x, b)"), 2.0);
  EXPECT_EQ(value_of("stop(-x, b)"), 0.0);
}

TEST(Grammar, ChoosesByConditions) {
  EXPECT_EQ(value_of("if(x < b, 1, 2)"), 2.0);
  EXPECT_EQ(value_of("if(x >= 3 and not (b > 2 or zeta == 1), 1, 2)"), 1.0);
  EXPECT_EQ(value_of("if((x + b) > 3.5, 1, 2)"), 1.0);
  EXPECT_THAT(error_of("if(x, 1, 2)").what(), HasSubstr("a condition is needed"));
  EXPECT_THAT(error_of("1 + (x < b)").what(), HasSubstr("a number is needed"));
  EXPECT_THAT(error_of("x < b").what(), HasSubstr("if(condition, yes, no)"));
}

TEST(Grammar, TellsWhereATextIsWrong) {
  EXPECT_EQ(error_of("x + zta").position, 4U);
  EXPECT_THAT(error_of("x + zta").what(), HasSubstr("unknown name 'zta'; did you mean 'zeta'?"));
  EXPECT_THAT(error_of("sinn(x)").what(), HasSubstr("did you mean 'sin'?"));
  EXPECT_THAT(error_of("sin + 1").what(), HasSubstr("'sin' is a function"));
  EXPECT_THAT(error_of("sin(x, b)").what(), HasSubstr("sin() takes 1 argument, not 2"));
  EXPECT_THAT(error_of("(x + b").what(), HasSubstr("')' is missing"));
  EXPECT_EQ(error_of("x + b)").position, 5U);
  EXPECT_THAT(error_of("x +").what(), HasSubstr("ends too early"));
  EXPECT_THAT(error_of("").what(), HasSubstr("empty"));
  EXPECT_THAT(error_of("2x").what(), HasSubstr("a product is written with '*'"));
  EXPECT_THAT(error_of("1e999").what(), HasSubstr("too large"));
  EXPECT_THAT(error_of("x; system(b)").what(), HasSubstr("';' is not expected here"));
}

TEST(Grammar, RefusesWhatIsTooDeepOrTooLong) {
  EXPECT_THAT(error_of(std::string(10000, '(') + "x").what(), HasSubstr("deep"));
  EXPECT_THAT(error_of(std::string(10000, '-') + "x").what(), HasSubstr("deep"));
  std::string power = "x", sum = "x";
  for (int i = 0; i < 10000; ++i) {
    power += "^x";
    sum += " + x";
  }
  EXPECT_THAT(error_of(power).what(), HasSubstr("deep"));
  EXPECT_THAT(error_of(sum).what(), HasSubstr("[constants]"));
}

TEST(Caret, StandsUnderThePlace) {
  EXPECT_EQ(with_caret("x + zta", 4), "  x + zta\n      ^");
  EXPECT_EQ(with_caret("a\nb + c\nd", 6), "  b + c\n      ^");
  EXPECT_EQ(with_caret("ä + c", 5), "  ä + c\n      ^");
  const std::string cut = with_caret(std::string(1000, 'x'), 500);
  EXPECT_LT(cut.size(), 200U);
}

}  // namespace
}  // namespace gearsweep::testing
