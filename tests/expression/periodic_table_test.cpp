// Curves through measured points, against closed forms.
#include "expression/periodic_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <memory>
#include <numbers>

#include "expression/differentiate.hpp"
#include "expression/parse.hpp"
#include "expression/print.hpp"
#include "expression/tape.hpp"
#include "model/error.hpp"

namespace gearsweep::testing {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr int kPlaces = 1000;

// Points of a curve, from one phase on, with distances that differ by up to `bent` of their mean.
template <class Curve>
std::vector<TablePoint> points_of(const Curve& curve, int count, double from, double to,
                                  double bent) {
  std::vector<TablePoint> points;
  for (int i = 0; i < count; ++i) {
    const double share = (i + bent * std::sin(3.0 * i)) / count;
    const double phase = from + (to - from) * share;
    points.push_back({phase, curve(phase)});
  }
  return points;
}

template <class Curve>
double largest_error(const PeriodicTable& table, const Curve& curve) {
  double largest = 0.0;
  for (int i = 0; i < kPlaces; ++i) {
    const double phase = kTurn * (i + 0.5) / kPlaces;
    largest = std::max(largest, std::fabs(table.at(phase, phase) - curve(phase)));
  }
  return largest;
}

double wave(double phase) { return std::cos(phase) + 0.3 * std::sin(2.0 * phase); }

TEST(PeriodicTable, IsStraightBetweenPoints) {
  const PeriodicTable table("saw", {{0.5, 1.0}, {1.5, 3.0}, {4.5, -3.0}}, Interpolation::linear);
  const auto at = [&](double phase) { return table.at(phase, phase); };
  EXPECT_EQ(at(0.5), 1.0);
  EXPECT_EQ(at(1.0), 2.0);
  EXPECT_EQ(at(1.5), 3.0);
  EXPECT_EQ(at(3.0), 0.0);
  // From the last point to the first one, a period later.
  EXPECT_NEAR(at(0.5 * (4.5 + 0.5 + kTurn)), -1.0, 1e-14);
  EXPECT_NEAR(at(0.0), 1.0 - 4.0 * 0.5 / (kTurn - 4.0), 1e-14);
}

// Halving the distance leaves a quarter of the error, or a sixteenth.
TEST(PeriodicTable, HasTheOrderOfItsInterpolation) {
  for (const double bent : {0.0, 0.2}) {
    for (const Interpolation interpolation : {Interpolation::linear, Interpolation::cubic}) {
      const double factor = interpolation == Interpolation::linear ? 4.0 : 16.0;
      const auto error = [&](int count) {
        return largest_error(
            PeriodicTable("wave", points_of(wave, count, 0.1, 0.1 + kTurn, bent), interpolation),
            wave);
      };
      EXPECT_THAT(error(100) / error(200), DoubleNear(factor, 0.15 * factor)) << bent;
    }
  }
}

// The error of a cubic spline through n equidistant points of a cosine is h^4/384 of its fourth
// derivative, which is 1: between the points, where that is largest.
TEST(PeriodicTable, HasTheKnownErrorOfASpline) {
  constexpr int kCount = 64;
  const auto cosine = [](double phase) { return std::cos(phase); };
  const PeriodicTable table("cosine", points_of(cosine, kCount, 0.0, kTurn, 0.0),
                            Interpolation::cubic);
  const double known = std::pow(kTurn / kCount, 4) / 384.0;
  EXPECT_NEAR(largest_error(table, cosine), known, 0.05 * known);
}

TEST(PeriodicTable, TurnsOnForEver) {
  for (const Interpolation interpolation : {Interpolation::linear, Interpolation::cubic}) {
    const PeriodicTable table("wave", points_of(wave, 20, 0.1, 0.1 + kTurn, 0.2), interpolation);
    for (int i = 0; i < kPlaces; ++i) {
      const double phase = kTurn * i / kPlaces, value = table.at(phase, phase);
      for (const int turns : {-1000, -1, 1, 1000}) {
        const double far = phase + kTurn * turns;
        ASSERT_NEAR(table.at(far, far), value, 1e-11);
      }
      const double next = phase + 1e-9;
      ASSERT_NEAR(table.at(next, next), value, 1e-8) << phase;
    }
    EXPECT_TRUE(std::isnan(table.at(INFINITY, INFINITY)));
    EXPECT_TRUE(table.jumps().empty());
  }
}

// A saw: from -1 up to 1 twice in a period.
TEST(PeriodicTable, IsReadOnEitherSideOfAJump) {
  const std::vector<TablePoint> saw = {{1.0, 1.0}, {1.0, -1.0}, {4.0, 1.0}, {4.0, -1.0}};
  const PeriodicTable table("saw", saw, Interpolation::linear);
  EXPECT_THAT(table.jumps(), ElementsAre(1.0, 4.0));
  EXPECT_EQ(table.at(1.0, 2.0), -1.0);
  EXPECT_EQ(table.at(1.0, 0.5), 1.0);
  EXPECT_EQ(table.at(4.0, 2.0), 1.0);
  EXPECT_EQ(table.at(4.0, 5.0), -1.0);
  EXPECT_EQ(table.at(2.5, 2.0), 0.0);
  // What a rounded phase is beyond the jump does not count.
  EXPECT_EQ(table.at(std::nextafter(4.0, 5.0), 2.0), 1.0);
  EXPECT_EQ(table.at(std::nextafter(4.0, 3.0), 5.0), -1.0);
  // Around the beginning of the period.
  EXPECT_NEAR(table.at(0.0, 0.5), 1.0 - 2.0 / (kTurn - 3.0), 1e-14);
  EXPECT_NEAR(table.at(kTurn, 6.0), 1.0 - 2.0 / (kTurn - 3.0), 1e-14);
}

// Each piece keeps fourth order up to its ends, also one of four points or three.
TEST(PeriodicTable, BendsPieceByPiece) {
  const auto pieces = [](double phase) {
    return phase < 2.0 ? std::exp(phase) : std::sin(phase) * phase;
  };
  const auto error = [&](int count) {
    std::vector<TablePoint> points;
    for (int i = 0; i <= count; ++i) {
      const double phase = 2.0 * i / count;
      points.push_back({phase, std::exp(phase)});
    }
    for (int i = 0; i <= count; ++i) {
      const double phase = 2.0 + (kTurn - 2.0) * i / count;
      points.push_back({phase, std::sin(phase) * phase});
    }
    points.insert(points.begin(), {0.0, points.back().value});
    points.pop_back();
    return largest_error(PeriodicTable("pieces", points, Interpolation::cubic), pieces);
  };
  EXPECT_THAT(error(40) / error(80), DoubleNear(16.0, 3.0));
  // A parabola through three points and a cubic through four are exact.
  for (const int count : {2, 3}) {
    const auto power = [&](double phase) { return std::pow(phase, count); };
    std::vector<TablePoint> points = {{0.0, power(kTurn)}};
    for (int i = 0; i < count; ++i) {
      const double phase = kTurn * (i == 0 ? 0.0 : i + 0.1) / count;
      points.push_back({phase, power(phase)});
    }
    const PeriodicTable table("power", points, Interpolation::cubic);
    EXPECT_LT(largest_error(table, power), 1e-12) << count;
  }
}

TEST(PeriodicTable, OfTooFewPointsIsRefused) {
  const std::vector<TablePoint> two = {{0.0, 1.0}, {1.0, 2.0}};
  EXPECT_NO_THROW(PeriodicTable("two", two, Interpolation::linear));
  EXPECT_THAT([&] { PeriodicTable("two", two, Interpolation::cubic); },
              ::testing::ThrowsMessage<InputError>(
                  HasSubstr("'two' has 2 points; a cubic table needs at least 3")));
}

// An expression of tables and names.
class TableText : public ::testing::Test {
 protected:
  NodeId parse(const std::string& text) {
    const ExpressionNames names = {.find = [&](const std::string& name) -> std::optional<NodeId> {
                                     if (name.starts_with("tab")) return std::nullopt;
                                     return graph_.symbol(name);
                                   },
                                   .known = [] { return std::vector<std::string>(); },
                                   .table =
                                       [&](const TableCall& call) {
                                         auto& table = tables_[{call.file, call.interpolation}];
                                         if (table == nullptr) {
                                           table = std::make_shared<const PeriodicTable>(
                                               call.file, points_of(wave, 20, 0.0, kTurn, 0.0),
                                               call.interpolation);
                                         }
                                         return table;
                                       }};
    return parse_expression(text, names, &graph_);
  }
  std::string refusal(const std::string& text) {
    try {
      parse(text);
    } catch (const ExpressionError& error) {
      return std::to_string(error.position) + ": " + error.what();
    }
    return "accepted";
  }

  ExpressionGraph graph_;
  std::map<std::pair<std::string, Interpolation>, std::shared_ptr<const PeriodicTable>> tables_;
};

TEST_F(TableText, IsPrintedAndParsedAsTheSame) {
  for (const std::string text :
       {"table(\"mesh.csv\", phase)", "1 + 2*table( 'a \"b\".csv' , phase + shift, cubic )",
        "table(\"a'b.csv\", table('mesh.csv', 2*phase, linear))^2"}) {
    const NodeId tree = parse(text);
    const std::string printed = to_text(graph_, tree);
    EXPECT_EQ(parse(printed), tree) << printed;
  }
  EXPECT_EQ(to_text(graph_, parse("table('m.csv', phase, linear)")), "table(\"m.csv\", phase)");
  EXPECT_NE(parse("table('m.csv', phase)"), parse("table('m.csv', phase, cubic)"));
  EXPECT_NE(parse("table('m.csv', phase)"), parse("table('n.csv', phase)"));
}

TEST_F(TableText, IsEvaluatedAndRewritten) {
  const NodeId sum = parse("x + 0*y + table('m.csv', 2*phase, cubic)*table('m.csv', phase)");
  const NodeId x = graph_.symbol("x"), phase = graph_.symbol("phase");
  const NodeId simple = Rewriter(&graph_, {})(sum);
  const PeriodicTable& cubic = *tables_[{"m.csv", Interpolation::cubic}];
  const PeriodicTable& linear = *tables_[{"m.csv", Interpolation::linear}];
  EXPECT_EQ(Tape(graph_, {x, phase}, {simple}).run({1.0, 0.7}),
            1.0 + cubic.at(1.4, 1.4) * linear.at(0.7, 0.7));
  EXPECT_EQ(derivative(&graph_, simple, x), graph_.number(1.0));
  const NodeId moved = Rewriter(&graph_, {{phase, graph_.symbol("inside")}})(simple);
  EXPECT_EQ(to_text(graph_, moved),
            to_text(graph_, Rewriter(&graph_,
                                     {})(parse("x + table('m.csv', 2*inside, cubic)*table('m.csv', "
                                               "inside)"))));
}

TEST_F(TableText, IsRefusedWithThePlace) {
  EXPECT_THAT(refusal("1 + table"), HasSubstr("4: 'table' is a function: table(\"file.csv\""));
  EXPECT_THAT(refusal("table()"), HasSubstr("6: the name of a file must stand here, in quotes"));
  EXPECT_THAT(refusal("table(mesh, phase)"), HasSubstr("6: the name of a file must stand here"));
  EXPECT_THAT(refusal("table('mesh, phase)"), HasSubstr("6: the name of a file has no quote"));
  EXPECT_THAT(refusal("table('', phase)"), HasSubstr("6: this cannot be the name of a file"));
  EXPECT_THAT(refusal("table('a\nb', phase)"), HasSubstr("6: this cannot be the name of a file"));
  EXPECT_THAT(refusal("table('m.csv')"), HasSubstr("13: ',' and the phase are missing"));
  EXPECT_THAT(refusal("table('m.csv', phase < 1)"), HasSubstr("15: a condition stands where"));
  EXPECT_THAT(refusal("table('m.csv', phase, cubical)"), HasSubstr("22: a table is read as"));
  EXPECT_THAT(refusal("table('m.csv', phase, cubic, 2)"), HasSubstr("27: ')' is missing"));
  EXPECT_THAT(refusal("tabel('m.csv', phase)"), HasSubstr("did you mean 'table'?"));
}

}  // namespace
}  // namespace gearsweep::testing
