#include "reference/detail/step_curve.hpp"

#include <Eigen/LU>
#include <cmath>
#include <vector>

namespace gearsweep {
namespace {

// The zero of a function that is positive at one end and not at the other, to rounding.
template <class Function>
double bisect(double from, double to, const Function& function) {
  const bool is_positive = function(from) > 0.0;
  while (true) {
    const double middle = 0.5 * (from + to);
    if (middle == from || middle == to) return middle;
    ((function(middle) > 0.0) == is_positive ? from : to) = middle;
  }
}

}  // namespace

StepCurve::StepCurve(double before, double middle, double after, std::optional<double> earlier)
    : middle_(middle) {
  std::vector<double> t = {-1.0, 0.0, 1.0};
  std::vector<double> values = {before - middle, 0.0, after - middle};
  if (earlier) {
    t.push_back(-2.0);
    values.push_back(*earlier - middle);
  }
  const auto count = static_cast<Eigen::Index>(t.size());
  Eigen::MatrixXd powers(count, count);  // [node][exponent]
  for (Eigen::Index i = 0; i < count; ++i) {
    for (Eigen::Index j = 0; j < count; ++j) {
      powers(i, j) = std::pow(t[static_cast<std::size_t>(i)], static_cast<double>(j));
    }
  }
  factors_ = powers.partialPivLu().solve(Eigen::Map<const Eigen::VectorXd>(values.data(), count));
}

double StepCurve::value(double t) const {
  double sum = 0.0;
  for (Eigen::Index i = factors_.size() - 1; i > 0; --i) sum = (sum + factors_[i]) * t;
  return middle_ + sum;
}

double StepCurve::slope(double t) const {
  double sum = 0.0;
  for (Eigen::Index i = factors_.size() - 1; i > 0; --i) {
    sum = sum * t + static_cast<double>(i) * factors_[i];
  }
  return sum;
}

std::optional<double> StepCurve::extremum() const {
  if (!(slope(-1.0) * slope(1.0) < 0.0)) return std::nullopt;
  return bisect(-1.0, 1.0, [this](double t) { return slope(t); });
}

double StepCurve::zero(double from, double to) const {
  return bisect(from, to, [this](double t) { return value(t); });
}

}  // namespace gearsweep
