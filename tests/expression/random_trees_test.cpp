// What must hold of any expression, on random ones.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "expression/differentiate.hpp"
#include "expression/parse.hpp"
#include "expression/print.hpp"
#include "expression/tape.hpp"

namespace gearsweep::testing {
namespace {

constexpr int kTrees = 10000;
const std::vector<std::string> kNames = {"x", "y", "p"};

// A value and its derivative, by the rules of dual numbers: a second way to a derivative that
// shares nothing with the first.
struct Dual {
  double value = 0.0, slope = 0.0;
};

Dual dual_of(Operation operation, const std::array<Dual, 3>& from) {
  const auto [a, da] = from[0];
  const auto [b, db] = from[1];
  const double value = apply(operation, a, b, from[2].value);
  switch (operation) {
    case Operation::negate:
      return {value, -da};
    case Operation::add:
      return {value, da + db};
    case Operation::subtract:
      return {value, da - db};
    case Operation::multiply:
      return {value, da * b + a * db};
    case Operation::divide:
      return {value, (da * b - a * db) / (b * b)};
    case Operation::power: {
      const double by_exponent = db == 0.0 ? 0.0 : value * std::log(a) * db;
      const double by_base = da == 0.0 ? 0.0 : b * std::pow(a, b - 1.0) * da;
      return {value, by_base + by_exponent};
    }
    case Operation::sine:
      return {value, std::cos(a) * da};
    case Operation::cosine:
      return {value, -std::sin(a) * da};
    case Operation::tangent:
      return {value, da / (std::cos(a) * std::cos(a))};
    case Operation::arcsine:
      return {value, da / std::sqrt(1.0 - a * a)};
    case Operation::arccosine:
      return {value, -da / std::sqrt(1.0 - a * a)};
    case Operation::arctangent:
      return {value, da / (1.0 + a * a)};
    case Operation::arctangent_of_two:
      return {value, (da * b - a * db) / (a * a + b * b)};
    case Operation::hyperbolic_sine:
      return {value, std::cosh(a) * da};
    case Operation::hyperbolic_cosine:
      return {value, std::sinh(a) * da};
    case Operation::hyperbolic_tangent:
      return {value, da / (std::cosh(a) * std::cosh(a))};
    case Operation::exponential:
      return {value, std::exp(a) * da};
    case Operation::logarithm:
      return {value, da / a};
    case Operation::square_root:
      return {value, da / (2.0 * std::sqrt(a))};
    case Operation::square_root_above_one:
      return {value, da / (2.0 * std::sqrt(1.0 + a))};
    case Operation::absolute:
      return {value, a < 0.0 ? -da : da};
    case Operation::min:
      return {value, b < a ? db : da};
    case Operation::max:
      return {value, a < b ? db : da};
    case Operation::backlash:
      return {value, (b < a ? da - db : 0.0) + (a < -b ? da + db : 0.0)};
    case Operation::stop:
      return {value, b < a ? da - db : 0.0};
    case Operation::select:
      return {value, a != 0.0 ? db : from[2].slope};
    default:  // conditions, sign, floor
      return {value, 0.0};
  }
}

// Along the first name.
Dual dual_value(const ExpressionGraph& graph, NodeId root, const std::vector<double>& at) {
  std::vector<Dual> duals(graph.size());
  for (const NodeId id : parts_of(graph, {root})) {
    const Node& node = graph[id];
    if (node.operation == Operation::number) {
      duals[id] = {node.number, 0.0};
    } else if (node.operation == Operation::symbol) {
      const auto index =
          static_cast<std::size_t>(std::ranges::find(kNames, node.symbol) - kNames.begin());
      duals[id] = {at[index], index == 0 ? 1.0 : 0.0};
    } else {
      std::array<Dual, 3> from;
      for (std::size_t i = 0; i < node.arguments.size(); ++i) from[i] = duals[node.arguments[i]];
      duals[id] = dual_of(node.operation, from);
    }
  }
  return duals[root];
}

class RandomTrees {
 public:
  explicit RandomTrees(unsigned seed) : random_(seed) {}

  NodeId number(ExpressionGraph* graph, int depth) {
    if (depth == 0 || below(8) == 0) {
      if (below(3) == 0) return graph->number(0.25 * (below(33) - 16));
      return graph->symbol(kNames[static_cast<std::size_t>(below(3))]);
    }
    constexpr int kFirst = static_cast<int>(Operation::negate);
    constexpr int kPlain = static_cast<int>(Operation::less) - kFirst;
    const int choice = below(kPlain + 1);
    if (choice == kPlain) {
      return graph->as_written(
          Operation::select,
          {condition(graph, depth - 1), number(graph, depth - 1), number(graph, depth - 1)});
    }
    const auto operation = static_cast<Operation>(kFirst + choice);
    std::vector<NodeId> arguments;
    for (std::size_t i = 0; i < arity(operation); ++i)
      arguments.push_back(number(graph, depth - 1));
    return graph->as_written(operation, arguments);
  }

  std::vector<double> place() {
    std::uniform_real_distribution<double> numbers(-3.0, 3.0);
    return {numbers(random_), numbers(random_), numbers(random_)};
  }

 private:
  NodeId condition(ExpressionGraph* graph, int depth) {
    const int choice = depth == 0 ? below(3) : below(6);
    const auto operation = static_cast<Operation>(static_cast<int>(Operation::less) + choice);
    std::vector<NodeId> arguments;
    for (std::size_t i = 0; i < arity(operation); ++i) {
      arguments.push_back(choice < 3 ? number(graph, depth == 0 ? 0 : depth - 1)
                                     : condition(graph, depth - 1));
    }
    return graph->as_written(operation, arguments);
  }
  int below(int limit) { return std::uniform_int_distribution<int>(0, limit - 1)(random_); }

  std::mt19937 random_;
};

std::vector<NodeId> symbols_of(ExpressionGraph* graph) {
  std::vector<NodeId> symbols;
  for (const std::string& name : kNames) symbols.push_back(graph->symbol(name));
  return symbols;
}

// Whether all parts have finite values, too, and derivatives where these are asked for.
bool is_finite_throughout(const ExpressionGraph& graph, NodeId root,
                          const std::vector<double>& at) {
  return std::ranges::all_of(parts_of(graph, {root}), [&](NodeId part) {
    const Dual dual = dual_value(graph, part, at);
    if (!std::isfinite(dual.value) || !std::isfinite(dual.slope)) return false;
    // The logarithm of the base is a part of a power whose exponent may change.
    const Node& node = graph[part];
    return node.operation != Operation::power || graph.is_number(node.arguments[1]) ||
           dual_value(graph, node.arguments[0], at).value > 0.0;
  });
}

// Within rounding, which is larger where large numbers cancel each other.
bool are_close(double a, double b) {
  return std::fabs(a - b) <= 1e-6 * (1.0 + std::fabs(a) + std::fabs(b));
}

TEST(RandomTrees, ArePrintedAndParsedAsTheSame) {
  RandomTrees trees(1);
  for (int i = 0; i < kTrees; ++i) {
    ExpressionGraph graph;
    const NodeId tree = trees.number(&graph, 6);
    const ExpressionNames names = {
        .find = [&](const std::string& name) { return std::optional(graph.symbol(name)); },
        .known = [] { return kNames; }};
    const std::string text = to_text(graph, tree);
    ASSERT_EQ(parse_expression(text, names, &graph), tree) << text;
  }
}

// For several thousand trees: many others have no finite value at a random place.
TEST(RandomTrees, HaveTheDerivativesOfDualNumbers) {
  RandomTrees trees(2);
  int compared = 0, close = 0;
  for (int i = 0; i < kTrees; ++i) {
    ExpressionGraph graph;
    const NodeId tree = trees.number(&graph, 5);
    const std::vector<NodeId> symbols = symbols_of(&graph);
    const NodeId slope = derivative(&graph, tree, symbols[0]);
    const std::vector<double> at = trees.place();
    const Dual expected = dual_value(graph, tree, at);
    if (!is_finite_throughout(graph, tree, at) || std::fabs(expected.slope) > 1e8) continue;
    ++compared;
    const double found = Tape(graph, symbols, {slope}).run(at);
    if (are_close(found, expected.slope)) {
      ++close;
    } else {
      ADD_FAILURE() << to_text(graph, tree) << " at " << at[0] << ", " << at[1] << ", " << at[2]
                    << ": " << found << ", not " << expected.slope;
    }
  }
  EXPECT_GT(compared, kTrees / 3);
  EXPECT_EQ(close, compared);
}

// The branch that is not taken may have no value there.
TEST(Derivative, IsFiniteWhereTheOtherBranchIsNot) {
  ExpressionGraph graph;
  const ExpressionNames names = {
      .find = [&](const std::string& name) { return std::optional(graph.symbol(name)); },
      .known = [] { return kNames; }};
  const NodeId hertz = parse_expression("-3*if(x > 0, x^1.5, 0)*p", names, &graph);
  const std::vector<NodeId> symbols = symbols_of(&graph);
  const Tape slope(graph, symbols, {derivative(&graph, hertz, symbols[0])});
  EXPECT_EQ(slope.run({-1.0, 0.0, 1.0}), 0.0);
  EXPECT_EQ(slope.run({4.0, 0.0, 1.0}), -9.0);
}

// To the bit, for a number of places that fills no block; and as well where x is known before.
TEST(RandomTrees, HaveTheSameValuesAtManyPlacesAtOnce) {
  constexpr std::size_t kMany = 21;
  RandomTrees trees(4);
  for (int i = 0; i < kTrees / 10; ++i) {
    ExpressionGraph graph;
    const NodeId tree = trees.number(&graph, 6);
    const Tape tape(graph, symbols_of(&graph), {tree});
    const double x = trees.place()[0];
    const Tape of_x = tape.given({x});
    std::vector<double> columns(3 * kMany), values(kMany), values_of_x(kMany);
    for (std::size_t place = 0; place < kMany; ++place) {
      const std::vector<double> at = trees.place();
      for (std::size_t k = 0; k < 3; ++k) columns[k * kMany + place] = k == 0 ? x : at[k];
    }
    tape.run_many(kMany, columns.data(), values.data());
    of_x.run_many(kMany, columns.data() + kMany, values_of_x.data());
    for (std::size_t place = 0; place < kMany; ++place) {
      const std::vector<double> at = {x, columns[kMany + place], columns[2 * kMany + place]};
      const double expected = tape.run(at);
      if (!is_finite_throughout(graph, tree, at)) continue;
      ASSERT_EQ(values[place], expected) << to_text(graph, tree);
      ASSERT_EQ(values_of_x[place], expected) << to_text(graph, tree);
    }
  }
}

TEST(RandomTrees, KeepTheirValuesWhenSimplified) {
  RandomTrees trees(3);
  int compared = 0;
  for (int i = 0; i < kTrees; ++i) {
    ExpressionGraph graph;
    const NodeId tree = trees.number(&graph, 6);
    const std::vector<NodeId> symbols = symbols_of(&graph);
    const NodeId simple = Rewriter(&graph, {})(tree);
    const std::vector<double> at = trees.place();
    std::array<double, 2> values{};
    Tape(graph, symbols, {tree, simple}).run(at.data(), values.data());
    if (!is_finite_throughout(graph, tree, at) || std::fabs(values[0]) > 1e8) continue;
    ++compared;
    ASSERT_TRUE(are_close(values[0], values[1])) << to_text(graph, tree) << "\n"
                                                 << to_text(graph, simple);
  }
  EXPECT_GT(compared, kTrees / 3);
}

}  // namespace
}  // namespace gearsweep::testing
