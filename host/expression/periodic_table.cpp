#include "expression/periodic_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "model/error.hpp"

namespace gearsweep {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr std::size_t kFewest = 2, kFewestCubic = 3;

// lower x[i - 1] + diagonal x[i] + upper x[i + 1] = right.
struct Row {
  double lower, diagonal, upper, right;
};

// Elimination without pivots: the diagonal outweighs what stands beside it.
std::vector<double> solve(std::vector<Row> rows) {
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const double factor = rows[i].lower / rows[i - 1].diagonal;
    rows[i].diagonal -= factor * rows[i - 1].upper;
    rows[i].right -= factor * rows[i - 1].right;
  }
  std::vector<double> x(rows.size());
  for (std::size_t i = rows.size(); i-- > 0;) {
    const double above = i + 1 < rows.size() ? rows[i].upper * x[i + 1] : 0.0;
    x[i] = (rows[i].right - above) / rows[i].diagonal;
  }
  return x;
}

// Where the first row's lower neighbour is the last unknown, and the other way round: the matrix is
// one without these corners and a product of two vectors (Sherman and Morrison).
std::vector<double> solve_cyclic(std::vector<Row> rows) {
  const double corner = rows.front().lower, other = rows.back().upper;
  const double gamma = -rows.front().diagonal;
  rows.front().diagonal -= gamma;
  rows.back().diagonal -= corner * other / gamma;
  std::vector<double> x = solve(rows);
  for (Row& row : rows) row.right = 0.0;
  rows.front().right = gamma;
  rows.back().right = other;
  const std::vector<double> z = solve(rows);
  const double factor =
      (x.front() + corner * x.back() / gamma) / (1.0 + z.front() + corner * z.back() / gamma);
  for (std::size_t i = 0; i < x.size(); ++i) x[i] -= factor * z[i];
  return x;
}

// Solves for a spline's second derivatives: its slope is the same on both sides of the middle one
// of three knots.
template <class Knot>
Row smooth_row(const Knot& before, const Knot& knot, const Knot& after, double phase_before) {
  const double left = knot.phase - phase_before, right = after.phase - knot.phase;
  const double turn = (after.value - knot.value) / right - (knot.value - before.value) / left;
  return {left, 2.0 * (left + right), right, 6.0 * turn};
}

}  // namespace

const char* name_of(Interpolation interpolation) {
  return interpolation == Interpolation::cubic ? "cubic" : "linear";
}

PeriodicTable::PeriodicTable(std::string name, const std::vector<TablePoint>& points,
                             Interpolation interpolation)
    : name_(std::move(name)), interpolation_(interpolation) {
  const std::size_t fewest = interpolation == Interpolation::cubic ? kFewestCubic : kFewest;
  if (points.size() < fewest) {
    throw InputError(fmt::format("'{}' has {} points; a {} table needs at least {}", name_,
                                 points.size(), name_of(interpolation), fewest));
  }
  const auto jump = std::ranges::adjacent_find(points, {}, &TablePoint::phase);
  const auto begin = jump == points.end() ? points.begin() : jump + 1;
  for (auto point = begin; point != points.end(); ++point) {
    knots_.push_back({point->phase, point->value});
  }
  for (auto point = points.begin(); point != begin; ++point) {
    knots_.push_back({point->phase + kTurn, point->value});
  }
  if (jump == points.end()) knots_.push_back({points[0].phase + kTurn, points[0].value});
  pieces_.push_back(0);
  for (std::size_t i = 0; i + 1 < knots_.size(); ++i) {
    if (knots_[i].phase == knots_[i + 1].phase) pieces_.push_back(i + 1);
  }
  if (jump != points.end()) {
    for (const std::size_t piece : pieces_) jumps_.push_back(knots_[piece].phase);
  }
  pieces_.push_back(knots_.size());
  if (interpolation != Interpolation::cubic) return;
  if (jump == points.end()) {
    bend_period();
  } else {
    for (std::size_t i = 0; i + 1 < pieces_.size(); ++i) {
      bend_piece(pieces_[i], pieces_[i + 1] - 1);
    }
  }
}

void PeriodicTable::bend_period() {
  const std::size_t last = knots_.size() - 1;  // the first one, a period later
  std::vector<Row> rows;
  rows.push_back(
      smooth_row(knots_[last - 1], knots_[0], knots_[1], knots_[last - 1].phase - kTurn));
  for (std::size_t i = 1; i < last; ++i) {
    rows.push_back(smooth_row(knots_[i - 1], knots_[i], knots_[i + 1], knots_[i - 1].phase));
  }
  const std::vector<double> bends = solve_cyclic(std::move(rows));
  for (std::size_t i = 0; i <= last; ++i) knots_[i].bend = bends[i % last];
}

// The first two intervals have one cubic, as have the last two ("not a knot"): so nothing is
// assumed of the ends, and their error is of fourth order, too.
void PeriodicTable::bend_piece(std::size_t first, std::size_t last) {
  if (last - first < 2) return;
  const auto length = [&](std::size_t i) { return knots_[i + 1].phase - knots_[i].phase; };
  std::vector<Row> rows;
  for (std::size_t i = first + 1; i < last; ++i) {
    rows.push_back(smooth_row(knots_[i - 1], knots_[i], knots_[i + 1], knots_[i - 1].phase));
  }
  // Through three knots: one parabola.
  const bool is_parabola = rows.size() == 1;
  const double begin = is_parabola ? 0.0 : length(first) / length(first + 1);
  const double end = is_parabola ? 0.0 : length(last - 1) / length(last - 2);
  rows.front().diagonal += rows.front().lower * (1.0 + begin);
  rows.front().upper -= rows.front().lower * begin;
  rows.back().diagonal += rows.back().upper * (1.0 + end);
  rows.back().lower -= rows.back().upper * end;
  const std::vector<double> bends = solve(std::move(rows));
  for (std::size_t i = 0; i < bends.size(); ++i) knots_[first + 1 + i].bend = bends[i];
  const auto bend = [&](std::size_t i) { return knots_[i].bend; };
  knots_[first].bend = bend(first + 1) + begin * (bend(first + 1) - bend(first + 2));
  knots_[last].bend = bend(last - 1) + end * (bend(last - 1) - bend(last - 2));
}

PeriodicTable::KnotShares PeriodicTable::shares_at(double phase, double toward) const {
  const double turns = kTurn * std::floor((toward - knots_.front().phase) / kTurn);
  const double side = toward - turns;
  const auto phase_of = [&](std::size_t knot) { return knots_[knot].phase; };
  const auto piece =
      std::ranges::upper_bound(pieces_.begin() + 1, pieces_.end() - 1, side, {}, phase_of);
  const std::size_t first = *(piece - 1), last = *piece - 1;
  const double x = std::clamp(phase - turns, phase_of(first), phase_of(last));
  const auto begin = knots_.begin();
  const auto after =
      std::ranges::upper_bound(begin + static_cast<std::ptrdiff_t>(first) + 1,
                               begin + static_cast<std::ptrdiff_t>(last), x, {}, &Knot::phase);
  return shares_in(static_cast<std::size_t>(after - 1 - begin), x);
}

PeriodicTable PeriodicTable::times(double factor) const {
  PeriodicTable scaled = *this;
  for (Knot& knot : scaled.knots_) {
    knot.value *= factor;
    knot.bend *= factor;
  }
  return scaled;
}

PeriodicTable PeriodicTable::bend() const {
  std::vector<TablePoint> points;
  for (const Knot& knot : knots_) points.push_back({knot.phase, knot.bend});
  points.pop_back();  // the first one, a period later
  return {name_, points, Interpolation::linear};
}

double PeriodicTable::at(double phase, double toward) const {
  if (!std::isfinite(phase) || !std::isfinite(toward)) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  return value_at(shares_at(phase, toward));
}

bool PeriodicTable::is_same_curve(const PeriodicTable& other) const {
  return interpolation_ == other.interpolation_ && knots_ == other.knots_ &&
         pieces_ == other.pieces_;
}

std::vector<double> PeriodicTable::corners() const {
  std::vector<double> corners;
  if (interpolation_ == Interpolation::cubic) return corners;
  const std::size_t last = knots_.size() - 1;
  const auto slope = [&](std::size_t i) {
    return (knots_[i + 1].value - knots_[i].value) / (knots_[i + 1].phase - knots_[i].phase);
  };
  const auto see = [&](std::size_t before, std::size_t after) {
    constexpr double kSameSlope = 1e-12;  // relative: rounding
    const double one = slope(before), other = slope(after);
    const double size = std::max(std::fabs(one), std::fabs(other));
    if (std::fabs(one - other) > kSameSlope * size) corners.push_back(knots_[after].phase);
  };
  if (jumps_.empty()) see(last - 1, 0);
  for (std::size_t i = 1; i < last; ++i) {
    const bool is_jump =
        knots_[i - 1].phase == knots_[i].phase || knots_[i].phase == knots_[i + 1].phase;
    if (!is_jump) see(i - 1, i);
  }
  return corners;
}

PeriodicTable::KnotShares PeriodicTable::shares_in(std::size_t interval, double phase) const {
  const Knot &left = knots_[interval], &right = knots_[interval + 1];
  const double b = (phase - left.phase) / (right.phase - left.phase);
  return {&left, &right, 1.0 - b, b};
}

double PeriodicTable::value_at(const KnotShares& shares) {
  const Knot &left = *shares.left, &right = *shares.right;
  const double length = right.phase - left.phase;
  const double a = shares.a, b = shares.b;
  const double line = left.value + b * (right.value - left.value);
  const double bent = (a * a - 1.0) * a * left.bend + (b * b - 1.0) * b * right.bend;
  return line + bent * length * length / 6.0;
}

double PeriodicTable::slope_at(const KnotShares& shares) {
  const Knot &left = *shares.left, &right = *shares.right;
  const double length = right.phase - left.phase;
  const double a = shares.a, b = shares.b;
  const double bent = (1.0 - 3.0 * a * a) * left.bend + (3.0 * b * b - 1.0) * right.bend;
  return (right.value - left.value) / length + bent * length / 6.0;
}

// The bend is linear in the phase: so far may the value be from the line through its ends, and the
// slope from its own.
void PeriodicTable::take_in(std::size_t interval, double from, double to, Range* range) const {
  const Knot &left = knots_[interval], &right = knots_[interval + 1];
  const double length = to - from;
  const double bend = std::max(std::fabs(left.bend), std::fabs(right.bend));
  const double turn = std::fabs(right.bend - left.bend) / (right.phase - left.phase);
  const double off = bend * length * length / 8.0, slope_off = turn * length * length / 8.0;
  for (const double phase : {from, to}) {
    const KnotShares shares = shares_in(interval, phase);
    const double value = value_at(shares), slope = slope_at(shares);
    range->low = std::min(range->low, value - off);
    range->high = std::max(range->high, value + off);
    range->slope_low = std::min(range->slope_low, slope - slope_off);
    range->slope_high = std::max(range->slope_high, slope + slope_off);
  }
}

PeriodicTable::Range PeriodicTable::range(double from, double to, double toward) const {
  constexpr double kUnbounded = std::numeric_limits<double>::infinity();
  if (!std::isfinite(from) || !std::isfinite(to) || !std::isfinite(toward)) {
    return {-kUnbounded, kUnbounded, -kUnbounded, kUnbounded};
  }
  const double turns = kTurn * std::floor((toward - knots_.front().phase) / kTurn);
  const bool is_whole = to - from >= kTurn;
  double low = is_whole ? knots_.front().phase : from - turns;
  double high = is_whole ? knots_.back().phase : to - turns;
  if (!jumps_.empty()) {
    const auto phase_of = [&](std::size_t knot) { return knots_[knot].phase; };
    const auto piece = std::ranges::upper_bound(pieces_.begin() + 1, pieces_.end() - 1,
                                                toward - turns, {}, phase_of);
    low = std::max(low, phase_of(*(piece - 1)));
    high = std::min(high, phase_of(*piece - 1));
  }
  Range range = {kUnbounded, -kUnbounded, kUnbounded, -kUnbounded};
  for (const double shift : {-kTurn, 0.0, kTurn}) take_in(low + shift, high + shift, &range);
  return range;
}

// Phases outside of the knots have no part.
void PeriodicTable::take_in(double low, double high, Range* range) const {
  const std::size_t last = knots_.size() - 1;
  if (high < knots_.front().phase || low > knots_[last].phase) return;
  const auto after = std::ranges::upper_bound(knots_, low, {}, &Knot::phase) - knots_.begin();
  for (std::size_t i = std::clamp<std::size_t>(static_cast<std::size_t>(after), 1, last); i <= last;
       ++i) {
    const double begin = knots_[i - 1].phase, end = knots_[i].phase;
    // What only touches an interval lies in the one before it.
    if (begin > low && begin >= high) break;
    if (begin < end)
      take_in(i - 1, std::clamp(low, begin, end), std::clamp(high, begin, end), range);
  }
}

}  // namespace gearsweep
