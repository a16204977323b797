// The self-test passes here, and each of its checks fails when what it looks at is wrong.
#include "verify/verify.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <ostream>

#include "model/error.hpp"
#include "support/run.hpp"

namespace gearsweep {

void PrintTo(const Check& check, std::ostream* out) { *out << check.name; }

}  // namespace gearsweep

namespace gearsweep::testing {
namespace {

using ::testing::HasSubstr;

const Subject kHere = {[](const Study& study) { return run(study); }};

// A device whose every answer is too large by this share. The reference engine is no device.
Subject spoilt(double share) {
  Subject subject;
  subject.compute = [share](const Study& study) {
    SweepResult result = run(study);
    if (study.integrate.engine == EngineKind::reference) return result;
    for (std::vector<double>& map : result.values) {
      for (double& value : map) value *= 1.0 + share;
    }
    for (double& sample : result.samples) sample *= 1.0 + share;
    return result;
  };
  return subject;
}

class EveryCheck : public ::testing::TestWithParam<Check> {};

TEST_P(EveryCheck, PassesHere) {
  const Outcome outcome = carry_out(GetParam(), {kHere});
  EXPECT_EQ(outcome.verdict, Verdict::pass)
      << outcome.reason << (outcome.worst ? describe(*outcome.worst) : "");
  EXPECT_GT(outcome.numbers, 0U);
}

// Whichever of its numbers is off, the check fails and shows that one.
TEST_P(EveryCheck, FailsWhenAnyOneOfItsNumbersIsOff) {
  const std::vector<Compared> right = GetParam().compare({kHere});
  for (std::size_t i = 0; i < right.size(); ++i) {
    std::vector<Compared> wrong = right;
    const double away = std::nextafter(wrong[i].expected, std::numeric_limits<double>::infinity());
    wrong[i].seen = wrong[i].tolerance > 0.0 ? wrong[i].expected + 1.01 * wrong[i].tolerance : away;
    const Outcome outcome = judge(wrong);
    ASSERT_EQ(outcome.verdict, Verdict::fail) << describe(wrong[i]);
    ASSERT_EQ(outcome.failed, 1U);
    ASSERT_EQ(describe(*outcome.worst), describe(wrong[i]));
  }
}

// Each share is some ten to thirty times what the check lets pass.
TEST_P(EveryCheck, FailsOnADeviceThatIsSlightlyWrong) {
  const std::map<std::string, double> shares = {
      {"linear oscillator", 1e-8},
      {"same bits", 2.3e-16},
      {"reference orbits", 1e-6},
      {"engines agree", 1e-10},
      {"exponent sum", 1e-6},
      {"published exponents", 0.1},
      {"multipliers", 1e-6},
      {"default step", 0.1},
      {"periods", 1.0},
      {"stopped points", 1e-2},
      {"linear oscillator, fp32", 1e-3},
      {"reference orbits, fp32", 1e-2},
      {"engines agree, fp32", 1e-2},
  };
  const auto share = shares.find(GetParam().name);
  if (share == shares.end()) {
    EXPECT_EQ(GetParam().name, "file and back");
    return;
  }
  const Outcome outcome = carry_out(GetParam(), spoilt(share->second));
  EXPECT_EQ(outcome.verdict, Verdict::fail);
  EXPECT_TRUE(outcome.worst && !outcome.worst->holds());
}

TEST_P(EveryCheck, FailsWhenTheSweepFails) {
  Subject broken;
  broken.compute = [](const Study&) -> SweepResult { throw RunError("the driver crashed"); };
  const Outcome outcome = carry_out(GetParam(), broken);
  EXPECT_EQ(outcome.verdict, Verdict::fail);
  EXPECT_THAT(outcome.reason, HasSubstr("the driver crashed"));
}

TEST_P(EveryCheck, IsSkippedOnlyForWantOfFp64) {
  Subject subject;
  subject.fp64 = false;
  subject.compute = [](const Study& study) {
    if (study.integrate.engine == EngineKind::opencl) {
      EXPECT_FALSE(study.integrate.fp64) << "a device without fp64 was asked for it";
    }
    return run(study);
  };
  const Outcome outcome = carry_out(GetParam(), subject);
  if (GetParam().needs_fp64) {
    EXPECT_EQ(outcome.verdict, Verdict::skipped);
    EXPECT_THAT(outcome.reason, HasSubstr("no fp64"));
  } else {
    EXPECT_EQ(outcome.verdict, Verdict::pass);
  }
}

INSTANTIATE_TEST_SUITE_P(All, EveryCheck, ::testing::ValuesIn(checks()), [](const auto& check) {
  std::string name = check.param.name;
  std::erase(name, ',');
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
});

const Check& check_named(const std::string& name) {
  const auto found = std::find_if(checks().begin(), checks().end(),
                                  [&](const Check& check) { return check.name == name; });
  if (found == checks().end()) throw std::logic_error("there is no check " + name);
  return *found;
}

// The file would hold what it was given; the second run of the same study shows it.
TEST(FileAndBack, FailsOnADeviceThatGivesOtherNumbersEachTime) {
  int calls = 0;
  Subject unsteady;
  unsteady.compute = [&calls](const Study& study) {
    SweepResult result = run(study);
    result.values[0][0] += ++calls;
    return result;
  };
  const Outcome outcome = carry_out(check_named("file and back"), unsteady);
  EXPECT_EQ(outcome.verdict, Verdict::fail);
  EXPECT_EQ(outcome.failed, 1U);
  EXPECT_EQ(outcome.worst->seen, outcome.worst->expected + 1.0);
}

// The same difference in rounding passes on a GPU.
TEST(SameBits, AreAskedOfCpusOnly) {
  Subject gpu = spoilt(2.3e-16);
  gpu.is_cpu = false;
  EXPECT_EQ(carry_out(check_named("same bits"), gpu).verdict, Verdict::pass);
}

TEST(Judge, NothingComparedIsNoPass) { EXPECT_EQ(judge({}).verdict, Verdict::fail); }

TEST(Judge, NotANumberFailsUnlessItIsExpected) {
  const double nan = std::nan("");
  EXPECT_EQ(judge({{"x", 1.0, nan, 0.1}}).verdict, Verdict::fail);
  EXPECT_EQ(judge({{"x", nan, 1.0, 0.1}}).verdict, Verdict::fail);
  EXPECT_EQ(judge({{"x", nan, nan, 0.0}}).verdict, Verdict::pass);
}

TEST(Judge, TheFiguresAreToldWithAllDigits) {
  EXPECT_EQ(describe({"x1", 1.25, 1.2500000000000002, 0.0}),
            "x1: expected 1.25, seen 1.2500000000000002 (the same number is needed)");
  EXPECT_EQ(describe({"x1", 1.25, 1.5, 1e-7}), "x1: expected 1.25, seen 1.5 (tolerance 1e-07)");
}

}  // namespace
}  // namespace gearsweep::testing
