// The phases at which an expression jumps or bends, against what is known of each form.
#include "equations/detail/phase_breaks.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "equations/detail/one_sided.hpp"
#include "expression/parse.hpp"
#include "model/error.hpp"

namespace gearsweep {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kTurn = 2.0 * kPi;

// An expression of the phase and of the parameters c and n.
struct Parsed {
  explicit Parsed(const std::string& text) {
    const ExpressionNames names = {
        .find = [&](const std::string& name) { return std::optional(graph.symbol(name)); },
        .known = [] { return std::vector<std::string>(); },
        .table =
            [](const TableCall& call) {
              const bool jumps = call.file == "jump";
              return std::make_shared<const PeriodicTable>(
                  call.file,
                  jumps ? std::vector<TablePoint>{{1.0, 0.0}, {1.0, 2.0}, {4.0, 1.0}}
                        : std::vector<TablePoint>{{0.5, 0.0}, {2.0, 1.0}, {3.0, 2.0}, {5.0, -1.0}},
                  call.interpolation);
            }};
    phase = graph.symbol("phase");
    inputs = {graph.symbol("c"), graph.symbol("n")};
    Rewriter simplify(&graph, {});
    root = simplify(parse_expression(text, names, &graph));
  }

  std::vector<double> breaks(double c = 0.0, double n = 0.0) {
    return PhaseBreaks(graph, inputs, phase, {root}, {}).find({c, n});
  }

  ExpressionGraph graph;
  NodeId phase = 0, root = 0;
  std::vector<NodeId> inputs;
};

std::vector<double> breaks_of(const std::string& text, double c = 0.0, double n = 0.0) {
  return Parsed(text).breaks(c, n);
}

auto At(const std::vector<double>& phases, double tolerance = 2e-15) {
  std::vector<::testing::Matcher<double>> near;
  for (const double phase : phases) near.push_back(::testing::DoubleNear(phase, tolerance));
  return ::testing::ElementsAreArray(near);
}

// What was found at other values is remembered for what decides the breaks alone: an object that
// was asked before answers as a new one does.
TEST(PhaseBreaks, AreThoseOfEachSettingWhateverWasAskedBefore) {
  std::mt19937 random(7);
  std::uniform_int_distribution<int> tenths(-12, 12);
  for (const char* text :
       {"n*sign(sin(phase) - c)", "if(c > 0, max(cos(phase), n), sign(sin(phase + n)))",
        "floor(n*sin(phase)) + c", "if(sin(phase) > c and n > 0, 1, 0)*c",
        "max(sin(phase), c)*step(cos(phase) - n)", "abs(c*sin(phase) + n*cos(phase))"}) {
    Parsed parsed(text);
    const PhaseBreaks asked(parsed.graph, parsed.inputs, parsed.phase, {parsed.root}, {});
    for (int i = 0; i < 200; ++i) {
      const double c = 0.1 * tenths(random), n = 0.1 * tenths(random);
      EXPECT_EQ(asked.find({c, n}), parsed.breaks(c, n)) << text << " at " << c << ", " << n;
    }
  }
}

TEST(PhaseBreaks, AreWhereEachFormJumpsOrBends) {
  EXPECT_THAT(breaks_of("sin(phase) + cos(3*phase)"), At({}));
  EXPECT_THAT(breaks_of("sign(sin(phase))"), At({kPi}));
  EXPECT_THAT(breaks_of("step(cos(phase))"), At({kPi / 2, 3 * kPi / 2}));
  EXPECT_THAT(breaks_of("if(sin(phase) > 0, sin(phase), 0)"), At({kPi}));
  EXPECT_THAT(breaks_of("if(phase >= 1 and phase < 4, 1, -1)"), At({1, 4}));
  EXPECT_THAT(breaks_of("if(not (phase < 1) and (phase <= 2 or phase > 5), 1, 0)"), At({1, 2, 5}));
  EXPECT_THAT(breaks_of("if(phase < 2, if(phase < 1, 3, 4), if(sin(phase) < 0, 1, 2))"),
              At({1, 2, kPi}));
  EXPECT_THAT(breaks_of("floor(3*phase/(2*pi) + 0.25)"),
              At({kTurn * 0.25, kTurn * 1.75 / 3, kTurn * 2.75 / 3}));
  EXPECT_THAT(breaks_of("abs(sin(2*phase))"), At({kPi / 2, kPi, 3 * kPi / 2}));
  EXPECT_THAT(breaks_of("max(cos(phase), 0)"), At({kPi / 2, 3 * kPi / 2}));
  EXPECT_THAT(breaks_of("clamp(2*sin(phase), -1, 1)"),
              At({kPi / 6, 5 * kPi / 6, 7 * kPi / 6, 11 * kPi / 6}));
  EXPECT_THAT(breaks_of("backlash(sin(phase), 0.5)"),
              At({kPi / 6, 5 * kPi / 6, 7 * kPi / 6, 11 * kPi / 6}));
  EXPECT_THAT(breaks_of("stop(sin(phase), 0.5)"), At({kPi / 6, 5 * kPi / 6}));
  EXPECT_THAT(breaks_of("asin(sin(phase))"), At({kPi / 2, 3 * kPi / 2}, 1e-8));
  EXPECT_THAT(breaks_of("acos(cos(phase))"), At({kPi}, 1e-8));
  EXPECT_THAT(breaks_of("atan(tan(phase))"), At({kPi / 2, 3 * kPi / 2}));
  EXPECT_THAT(breaks_of("atan2(sin(phase), cos(phase))"), At({kPi}));
  EXPECT_THAT(breaks_of("sign(1/cos(phase))"), At({kPi / 2, 3 * kPi / 2}));
  EXPECT_THAT(breaks_of("sqrt(max(sin(phase), 0))"), At({kPi}));
  EXPECT_THAT(breaks_of("max(sin(phase), 0)^1.5"), At({kPi}));
  EXPECT_THAT(breaks_of("sqrt(sin(phase)^2)"), At({kPi}, 1e-8));
  EXPECT_THAT(breaks_of("if(floor(phase) == 2, 1, 0)"), At({1, 2, 3, 4, 5, 6}));
  EXPECT_THAT(breaks_of("if(max(sin(phase), 0) == 0, 1, 2)"), At({kPi}));
  EXPECT_THAT(breaks_of("sign(cos(phase) - 0.3) * floor(2*sin(phase))"),
              At({kPi / 6, std::acos(0.3), kPi / 2, 5 * kPi / 6, kPi, 7 * kPi / 6, 3 * kPi / 2,
                  kTurn - std::acos(0.3), 11 * kPi / 6},
                 1e-8));
  EXPECT_THAT(breaks_of("sign(sin(phase)^3)"), At({kPi}, 1e-14));
  EXPECT_THAT(breaks_of("sign((phase - 2)^3)"), At({2}));
}

TEST(PhaseBreaks, FollowParameters) {
  for (const double c : {1.2, 1.6, 1.9}) {
    const std::vector<double> breaks = breaks_of("if(phase < 2*pi*(c - 1), 1.3, 0.8)", c);
    EXPECT_THAT(breaks, ::testing::ElementsAre(2.0 * kPi * (c - 1.0)));
  }
  EXPECT_THAT(breaks_of("if(phase < 2*pi*(c - 1), 1.3, 0.8)", 1.0), At({}));
  EXPECT_THAT(breaks_of("if(phase < 2*pi*(c - 1), 1.3, 0.8)", 2.5), At({}));
  EXPECT_THAT(breaks_of("sign(c*sin(n*phase))", 1.0, 3.0),
              At({kPi / 3, 2 * kPi / 3, kPi, 4 * kPi / 3, 5 * kPi / 3}));
  EXPECT_THAT(breaks_of("sign(c*sin(n*phase))", 0.0, 3.0), At({}));
  EXPECT_THAT(breaks_of("if(c > 0, sign(sin(phase)), abs(cos(phase)))", 1.0), At({kPi}));
  EXPECT_THAT(breaks_of("if(c > 0, sign(sin(phase)), abs(cos(phase)))", -1.0),
              At({kPi / 2, 3 * kPi / 2}));
}

// What is not taken breaks nothing, however often it would.
TEST(PhaseBreaks, AreThoseOfTheBranchThatIsTaken) {
  EXPECT_THAT(breaks_of("if(phase < 1, 0.5, if(phase < 2, floor(2*phase), 7))"), At({1, 1.5, 2}));
  EXPECT_THAT(breaks_of("if(phase > 3, sign(sin(1/phase)), 0)"), At({3}));
  EXPECT_THAT(breaks_of("if(phase < 1, floor(5000*phase)/5000*0 + floor(500*phase), 0)").size(),
              500U);
}

TEST(PhaseBreaks, ReadTables) {
  EXPECT_THAT(breaks_of("table('line', phase)"), At({0.5, 2.0, 3.0, 5.0}));
  EXPECT_THAT(breaks_of("table('line', phase, cubic)"), At({}));
  EXPECT_THAT(breaks_of("table('line', phase + c)", 1.0), At({1.0, 2.0, 4.0, kTurn - 0.5}));
  EXPECT_THAT(breaks_of("table('jump', 2*phase)"), At({0.5, 2.0, 0.5 + kPi, 2.0 + kPi}));
  EXPECT_THAT(breaks_of("sign(table('line', phase, cubic) - 0.5)").size(), 2U);
  EXPECT_THAT(breaks_of("if(table('jump', phase) > 1.5, 1, 0)"), At({1.0, 2.5, 4.0}));
}

TEST(PhaseBreaks, AreRefusedWhereTheyCannotBeTold) {
  const auto refusal = [](const std::string& text) {
    try {
      breaks_of(text);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_THAT(refusal("2 + sign(sin(5000*phase))"),
              ::testing::HasSubstr("sign(sin(5000*phase)) jumps or bends more than 1000 times"));
  EXPECT_THAT(refusal("floor(1e12*phase)"), ::testing::HasSubstr("more than 1000 times"));
  EXPECT_THAT(refusal("sign(sin(1e8*phase) + 2*sin(7e7*phase))"),
              ::testing::HasSubstr("more than 1000 times"));
  EXPECT_THAT(refusal("sign(sin(phase)^2 + cos(phase)^2 - 1)"),
              ::testing::HasSubstr("it cannot be told where in a period"));
  EXPECT_EQ(refusal("sign(sin(400*phase)/3)"), "");
}

// A random expression of the phase, with conditions in conditions.
class Generator {
 public:
  explicit Generator(unsigned seed) : random_(seed) {}

  std::string number(int depth) {
    switch (pick(depth > 0 ? 12 : 3)) {
      case 0:
        return digits(-2, 2);
      case 1:
        return "sin(" + wave() + ")";
      case 2:
        return "cos(" + wave() + ")";
      case 3:
        return "(" + number(depth - 1) + " + " + number(depth - 1) + ")";
      case 4:
        return "(" + number(depth - 1) + " * " + number(depth - 1) + ")";
      case 5:
      case 6:
        return "if(" + condition(depth - 1) + ", " + number(depth - 1) + ", " + number(depth - 1) +
               ")";
      case 7:
        return "floor(" + digits(1, 3) + "*" + number(depth - 1) + ")";
      case 8:
        return "sign(" + number(depth - 1) + ")";
      case 9:
        return "abs(" + number(depth - 1) + ")";
      case 10:
        return "max(" + number(depth - 1) + ", " + number(depth - 1) + ")";
      default:
        return "step(" + number(depth - 1) + ")";
    }
  }

 private:
  std::size_t pick(std::size_t count) { return random_() % count; }
  std::string digits(double from, double to) {
    return std::to_string(from + (to - from) * static_cast<double>(random_() >> 8U) / 16777216.0);
  }
  std::string wave() { return std::to_string(1 + pick(4)) + "*phase + " + digits(0, 6); }
  std::string condition(int depth) {
    switch (pick(depth > 0 ? 5 : 2)) {
      case 0:
        return "phase < " + digits(0, 6.3);
      case 1:
        return number(0) + " <= " + number(0);
      case 2:
        return condition(depth - 1) + " and " + condition(depth - 1);
      case 3:
        return "not (" + condition(depth - 1) + " or " + condition(depth - 1) + ")";
      default:
        return number(depth - 1) + " > " + number(depth - 1);
    }
  }

  std::mt19937 random_;
};

// Between two breaks the value taken from the middle is the value at each phase, and it and its
// slope go on: nothing is missed.
TEST(PhaseBreaks, LeaveSmoothPiecesOfRandomExpressions) {
  std::size_t broken = 0;
  for (unsigned seed = 0; seed < 500; ++seed) {
    const std::string text = Generator(seed).number(4);
    Parsed parsed(text);
    std::vector<double> bounds = parsed.breaks();
    broken += bounds.size();
    bounds.insert(bounds.begin(), 0.0);
    bounds.push_back(kTurn);
    const NodeId inside = parsed.graph.symbol("phase inside");
    const std::vector<NodeId> sided = one_sided(&parsed.graph, parsed.phase, inside, {parsed.root});
    const Tape plain(parsed.graph, {parsed.phase}, {parsed.root});
    const Tape tape(parsed.graph, {parsed.phase, inside}, sided);
    for (std::size_t i = 0; i + 1 < bounds.size(); ++i) {
      const double from = bounds[i], length = bounds[i + 1] - from;
      const double middle = from + 0.5 * length;
      double before = 0.0, last = 0.0;
      for (int j = 0; j <= 200; ++j) {
        const double share = 1e-3 + (1.0 - 2e-3) * j / 200.0;
        const double value = plain.run({from + share * length});
        const double scale = 1.0 + std::fabs(value);
        ASSERT_NEAR(tape.run({from + share * length, middle}), value, 1e-9 * scale)
            << text << " at " << from + share * length;
        // Second differences of what is smooth: no wave is faster than 16 phase.
        if (j > 1 && length > 1e-3) {
          const double step = length / 200.0;
          ASSERT_LT(std::fabs(value - 2.0 * last + before), 3000.0 * step * step + 1e-9)
              << text << " at " << from + share * length;
        }
        before = last;
        last = value;
      }
    }
  }
  EXPECT_GT(broken, 500U);
}

}  // namespace
}  // namespace gearsweep
