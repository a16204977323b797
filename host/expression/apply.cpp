// What operations make of numbers.
#include <cmath>

#include "expression/expression.hpp"

namespace gearsweep {
namespace {

// As lane_min and lane_max of kernels/dialect.h.
double min_of(double a, double b) { return b < a ? b : a; }
double max_of(double a, double b) { return a < b ? b : a; }

// The functions of one number; a itself of what is none.
double function_of(Operation operation, double a) {
  switch (operation) {
    case Operation::sine:
      return std::sin(a);
    case Operation::cosine:
      return std::cos(a);
    case Operation::tangent:
      return std::tan(a);
    case Operation::arcsine:
      return std::asin(a);
    case Operation::arccosine:
      return std::acos(a);
    case Operation::arctangent:
      return std::atan(a);
    case Operation::hyperbolic_sine:
      return std::sinh(a);
    case Operation::hyperbolic_cosine:
      return std::cosh(a);
    case Operation::hyperbolic_tangent:
      return std::tanh(a);
    case Operation::exponential:
      return std::exp(a);
    case Operation::logarithm:
      return std::log(a);
    case Operation::square_root:
      return std::sqrt(a);
    case Operation::absolute:
      return std::fabs(a);
    case Operation::floor:
      return std::floor(a);
    default:
      return a;
  }
}

}  // namespace

double apply(Operation operation, double a, double b, double c) {
  switch (operation) {
    case Operation::negate:
      return -a;
    case Operation::add:
      return a + b;
    case Operation::subtract:
      return a - b;
    case Operation::multiply:
      return a * b;
    case Operation::divide:
      return a / b;
    case Operation::power:
      return std::pow(a, b);
    case Operation::arctangent_of_two:
      return std::atan2(a, b);
    case Operation::square_root_above_one:
      return a / (1.0 + std::sqrt(1.0 + a));
    case Operation::sign:
      return a < 0.0 ? -1.0 : 0.0 < a ? 1.0 : 0.0;
    case Operation::min:
      return min_of(a, b);
    case Operation::max:
      return max_of(a, b);
    case Operation::backlash:
      return max_of(a - b, 0.0) + min_of(a + b, 0.0);
    case Operation::stop:
      return max_of(a - b, 0.0);
    case Operation::less:
      return a < b ? 1.0 : 0.0;
    case Operation::less_or_equal:
      return a <= b ? 1.0 : 0.0;
    case Operation::equal:
      return a == b ? 1.0 : 0.0;
    case Operation::conjunction:
      return a != 0.0 && b != 0.0 ? 1.0 : 0.0;
    case Operation::disjunction:
      return a != 0.0 || b != 0.0 ? 1.0 : 0.0;
    case Operation::negation:
      return a != 0.0 ? 0.0 : 1.0;
    case Operation::select:
      return a != 0.0 ? b : c;
    default:
      return function_of(operation, a);
  }
}

}  // namespace gearsweep
