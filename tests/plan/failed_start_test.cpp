// Why a point fails before its first step.
#include "plan/failed_start.hpp"

#include <gtest/gtest.h>

#include <string>

namespace gearsweep::testing {
namespace {

std::string failure(const std::string& v_rate, const std::string& initial = "") {
  const std::string toml =
      "[model]\ntext = \"\"\"\n[model]\nname = 'turning'\n[states]\nx = {}\ny = {}\n[parameters]\n"
      "a = 1.0\n[constants]\nr = 'sqrt(x*x + y*y)'\n[equations]\nx = 'y - a*x'\ny = '" +
      v_rate + "'\n[forcing]\nperiod = '1'\n\"\"\"\n[[axes]]\nname = 'a'\nvalues = [1.0]\n" +
      initial;
  return failure_at_start(Plan(read_study(toml, "test.toml"), 1), 0);
}

TEST(FailedStart, NamesTheExpressionAndTheStates) {
  EXPECT_EQ(failure("-x + y*(1 - x/r)"),
            "at its start, x = 0, y = 0, x/sqrt(x*x + y*y) is 0/0 in the equation of 'y'");
  EXPECT_EQ(failure("-x + log(r)", "[initial]\nstate = {x = 0.0}\n"),
            "at its start, x = 0, y = 0, log(sqrt(x*x + y*y)) is -inf in the equation of 'y'");
}

TEST(FailedStart, IsNoneWhereEquationsAreFinite) {
  EXPECT_EQ(failure("-x + y*(1 - x/r)", "[initial]\nstate = {x = 1.0}\n"), "");
  EXPECT_EQ(failure("-x + y*r"), "");
  // What a condition does not choose does not count.
  EXPECT_EQ(failure("-x + if(r > 0, y/r, 0)"), "");
}

}  // namespace
}  // namespace gearsweep::testing
