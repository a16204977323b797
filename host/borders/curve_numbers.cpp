#include "borders/curve_numbers.hpp"

#include <algorithm>
#include <complex>
#include <utility>

#include "model/error.hpp"

namespace gearsweep {
namespace {

class NumberWriter {
 public:
  void number(const double& value) { row_.push_back(value); }
  std::size_t whole(std::size_t value) {
    row_.push_back(static_cast<double>(value));
    return value;
  }
  std::size_t count(std::size_t value) { return whole(value); }
  template <typename Enum>
  Enum one_of(Enum value, Enum) {
    whole(static_cast<std::size_t>(value));
    return value;
  }
  std::vector<double> take() { return std::move(row_); }

 private:
  std::vector<double> row_;
};

class NumberReader {
 public:
  explicit NumberReader(std::span<const double> row) : row_(row) {}

  void number(double& value) {
    if (next_ == row_.size()) refuse();
    value = row_[next_++];
  }
  std::size_t whole(std::size_t) {
    double value = 0.0;
    number(value);
    if (!(value >= 0.0 && value <= kMost)) refuse();
    return static_cast<std::size_t>(value);
  }
  // No more things than the row has numbers left: each takes one at least.
  std::size_t count(std::size_t) {
    const std::size_t value = whole(0);
    if (value > row_.size() - next_) refuse();
    return value;
  }
  template <typename Enum>
  Enum one_of(Enum, Enum last) {
    const std::size_t value = whole(0);
    if (value > static_cast<std::size_t>(last)) refuse();
    return static_cast<Enum>(value);
  }
  bool is_at_end() const { return next_ == row_.size(); }
  [[noreturn]] static void refuse() {
    throw InputError("the journal is damaged (what stands there are no curves); delete it");
  }

 private:
  static constexpr double kMost = 1e8;
  std::span<const double> row_;
  std::size_t next_ = 0;
};

// Each of these says for both ways of which numbers a thing is made, and in which order.

template <typename Row>
void visit_vector(Row& row, Eigen::VectorXd& vector) {
  vector.resize(static_cast<Eigen::Index>(row.count(static_cast<std::size_t>(vector.size()))));
  for (double& value : vector) row.number(value);
}

template <typename Row>
void visit_vector(Row& row, Eigen::VectorXcd& vector) {
  vector.resize(static_cast<Eigen::Index>(row.count(static_cast<std::size_t>(vector.size()))));
  for (std::complex<double>& value : vector) {
    double real = value.real(), imag = value.imag();
    row.number(real);
    row.number(imag);
    value = {real, imag};
  }
}

template <typename Row>
void visit_place(Row& row, PlanePlace& place) {
  for (double& value : place) row.number(value);
}

template <typename Row, typename Element, typename Visit>
void visit_all(Row& row, std::vector<Element>& elements, const Visit& visit) {
  elements.resize(row.count(elements.size()));
  for (Element& element : elements) visit(row, element);
}

template <typename Row>
void visit_point(Row& row, BorderPoint& point) {
  visit_place(row, point.place);
  visit_vector(row, point.state);
  row.number(point.angle);
  visit_vector(row, point.multipliers);
  row.number(point.residual);
  row.number(point.fold_bend);
  row.number(point.overlap);
  row.number(point.transversality);
  visit_vector(row, point.tangent);
  visit_vector(row, point.critical.left);
  visit_vector(row, point.critical.right);
  row.number(point.critical.moment);
  point.iterations = static_cast<int>(row.whole(static_cast<std::size_t>(point.iterations)));
}

template <typename Row>
void visit_special(Row& row, SpecialPoint& special) {
  special.kind = row.one_of(special.kind, SpecialKind::corner);
  visit_place(row, special.place);
}

template <typename Row>
void visit_curve(Row& row, BorderCurve& curve) {
  curve.kind = row.one_of(curve.kind, BorderKind::grazing);
  curve.period = row.whole(curve.period);
  curve.limit.index = row.whole(curve.limit.index);
  curve.limit.is_from_below = row.whole(curve.limit.is_from_below ? 1 : 0) == 1;
  visit_vector(row, curve.scale.sizes);
  visit_place(row, curve.scale.ranges);
  row.number(curve.scale.level);
  visit_all(row, curve.points, visit_point<Row>);
  curve.start = row.whole(curve.start);
  curve.is_closed = row.whole(curve.is_closed ? 1 : 0) == 1;
  curve.begins = row.one_of(curve.begins, CurveEnd::too_long);
  curve.ends = row.one_of(curve.ends, CurveEnd::too_long);
  visit_all(row, curve.special, visit_special<Row>);
  visit_all(row, curve.stops, visit_point<Row>);
  row.number(curve.step_error);
  visit_all(row, curve.gradients, visit_place<Row>);
  curve.judged = row.whole(curve.judged);
}

}  // namespace

std::vector<double> numbers_of(const std::vector<BorderCurve>& curves) {
  NumberWriter row;
  std::vector<BorderCurve> own = curves;  // which the visit only reads
  visit_all(row, own, visit_curve<NumberWriter>);
  return row.take();
}

std::vector<BorderCurve> curves_of(std::span<const double> numbers) {
  NumberReader row(numbers);
  std::vector<BorderCurve> curves;
  visit_all(row, curves, visit_curve<NumberReader>);
  const bool has_starts = std::ranges::all_of(
      curves, [](const BorderCurve& curve) { return curve.start < curve.points.size(); });
  if (!row.is_at_end() || !has_starts) NumberReader::refuse();
  return curves;
}

}  // namespace gearsweep
