#include "expression/interval.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace gearsweep {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kRounding = 2.0 * std::numeric_limits<double>::epsilon();
constexpr double kHalfTurn = std::numbers::pi;
constexpr double kMaxWhole = 1e6;  // exponents that are seen as whole

bool is_zero(const Interval& a) { return a == Interval{}; }

Interval negative(const Interval& a) { return {-a.high, -a.low}; }

Interval sum(const Interval& a, const Interval& b) {
  if (is_zero(a)) return b;
  if (is_zero(b)) return a;
  return rounded(a.low + b.low, a.high + b.high);
}

// Nothing times infinity is nothing: an end stands for the numbers up to it.
double times(double a, double b) { return a == 0.0 || b == 0.0 ? 0.0 : a * b; }

Interval product(const Interval& a, const Interval& b) {
  if (is_zero(a) || is_zero(b)) return {};
  const auto [low, high] = std::minmax(
      {times(a.low, b.low), times(a.low, b.high), times(a.high, b.low), times(a.high, b.high)});
  return rounded(low, high);
}

Interval inverse(const Interval& a) {
  if (is_zero(a)) return Interval::all();
  if (a.low < 0.0 && 0.0 < a.high) return Interval::all();
  const double low = a.high == 0.0 ? -kInfinity : 1.0 / a.high;
  const double high = a.low == 0.0 ? kInfinity : 1.0 / a.low;
  return rounded(low, high);
}

Interval square(const Interval& a) {
  const auto [low, high] = std::minmax({std::fabs(a.low), std::fabs(a.high)});
  return rounded(a.contains(0.0) ? 0.0 : low * low, high * high);
}

// What a rising function makes of an interval.
template <class Function>
Interval rising(const Interval& a, const Function& function) {
  return rounded(function(a.low), function(a.high));
}

// Whether offset + n length lies in it, for a whole n.
bool meets(const Interval& a, double offset, double length) {
  return std::floor((a.high - offset) / length) > std::floor((a.low - offset) / length);
}

Interval sine(const Interval& a) {
  const double turn = 2.0 * kHalfTurn;
  if (!(a.high - a.low < turn)) return {-1.0, 1.0};
  const auto [low, high] = std::minmax({std::sin(a.low), std::sin(a.high)});
  return rounded(meets(a, -0.5 * kHalfTurn, turn) ? -1.0 : low,
                 meets(a, 0.5 * kHalfTurn, turn) ? 1.0 : high);
}

Interval cosine(const Interval& a) {
  return sine(rounded(a.low + 0.5 * kHalfTurn, a.high + 0.5 * kHalfTurn));
}

Interval tangent(const Interval& a) {
  if (!(a.high - a.low < kHalfTurn) || meets(a, 0.5 * kHalfTurn, kHalfTurn)) {
    return Interval::all();
  }
  return rising(a, [](double x) { return std::tan(x); });
}

Interval hyperbolic_cosine(const Interval& a) {
  const auto [low, high] = std::minmax({std::cosh(a.low), std::cosh(a.high)});
  return rounded(a.contains(0.0) ? 1.0 : low, high);
}

// Where that is not defined, nothing is said of it.
Interval clipped(const Interval& a, double low, double high) {
  return {std::clamp(a.low, low, high), std::clamp(a.high, low, high)};
}

Interval square_root(const Interval& a) {
  return rising(clipped(a, 0.0, kInfinity), [](double x) { return std::sqrt(x); });
}

Interval logarithm(const Interval& a) {
  return rising(clipped(a, 0.0, kInfinity), [](double x) { return std::log(x); });
}

Interval arcsine(const Interval& a) {
  return rising(clipped(a, -1.0, 1.0), [](double x) { return std::asin(x); });
}

Interval whole_power(const Interval& a, double exponent) {
  if (exponent < 0.0) return inverse(whole_power(a, -exponent));
  if (exponent == 0.0) return {1.0, 1.0};
  const auto [low, high] = std::minmax({std::pow(a.low, exponent), std::pow(a.high, exponent)});
  const bool is_even = std::fmod(exponent, 2.0) == 0.0;
  return rounded(is_even && a.contains(0.0) ? 0.0 : low, high);
}

Interval power(const Interval& a, const Interval& b) {
  if (b.low == b.high && b.low == std::floor(b.low) && std::fabs(b.low) < kMaxWhole) {
    return whole_power(a, b.low);
  }
  if (a.low < 0.0 || (a.low == 0.0 && b.low <= 0.0)) return Interval::all();
  const auto [low, high] = std::minmax({std::pow(a.low, b.low), std::pow(a.low, b.high),
                                        std::pow(a.high, b.low), std::pow(a.high, b.high)});
  return rounded(low, high);
}

// a: of a function of the variable; by: the function's derivative there.
Interval chained(const Enclosure& a, const Interval& by) { return product(by, a.slope); }

Enclosure multiply(const Enclosure& a, const Enclosure& b) {
  const bool is_square = &a == &b;
  if (is_square) return {square(a.value), product(product({2.0, 2.0}, a.value), a.slope)};
  return {product(a.value, b.value), sum(product(a.slope, b.value), product(a.value, b.slope))};
}

Enclosure invert(const Enclosure& a) {
  const Interval value = inverse(a.value);
  return {value, chained(a, negative(square(value)))};
}

Enclosure raise(const Enclosure& a, const Enclosure& b) {
  const Interval value = power(a.value, b.value);
  const Interval less = rounded(b.value.low - 1.0, b.value.high - 1.0);
  const bool is_number = b.value.low == b.value.high;
  const double one_less = b.value.low - 1.0;
  const Interval exponent = is_number ? Interval{one_less, one_less} : less;
  const Interval by_base = product(b.value, power(a.value, exponent));
  const Interval by_exponent = product(value, logarithm(a.value));
  return {value, sum(chained(a, by_base), chained(b, by_exponent))};
}

Enclosure angle_of(const Enclosure& a, const Enclosure& b) {
  if (a.value.contains(0.0) && b.value.low <= 0.0) {
    const bool is_constant = a.is_constant() && b.is_constant();
    return {{-kHalfTurn, kHalfTurn}, is_constant ? Interval{} : Interval::all()};
  }
  const auto at = [&](double y, double x) { return std::atan2(y, x); };
  const auto [low, high] =
      std::minmax({at(a.value.low, b.value.low), at(a.value.low, b.value.high),
                   at(a.value.high, b.value.low), at(a.value.high, b.value.high)});
  const Interval size = inverse(sum(square(a.value), square(b.value)));
  const Interval turned = sum(product(b.value, a.slope), negative(product(a.value, b.slope)));
  return {rounded(low, high), product(turned, size)};
}

// What a function of one argument makes of an enclosure.
Enclosure enclose_function(Operation operation, const Enclosure& a) {
  const Interval& x = a.value;
  const Interval one = {1.0, 1.0};
  switch (operation) {
    case Operation::sine:
      return {sine(x), chained(a, cosine(x))};
    case Operation::cosine:
      return {cosine(x), chained(a, negative(sine(x)))};
    case Operation::tangent: {
      const Interval value = tangent(x);
      return {value, chained(a, sum(one, square(value)))};
    }
    case Operation::arcsine:
    case Operation::arccosine: {
      const Interval by = inverse(square_root(sum(one, negative(square(x)))));
      const Interval value = arcsine(x);
      if (operation == Operation::arcsine) return {value, chained(a, by)};
      return {rounded(0.5 * kHalfTurn - value.high, 0.5 * kHalfTurn - value.low),
              chained(a, negative(by))};
    }
    case Operation::arctangent:
      return {rising(x, [](double at) { return std::atan(at); }),
              chained(a, inverse(sum(one, square(x))))};
    case Operation::hyperbolic_sine:
      return {rising(x, [](double at) { return std::sinh(at); }), chained(a, hyperbolic_cosine(x))};
    case Operation::hyperbolic_cosine:
      return {hyperbolic_cosine(x), chained(a, rising(x, [](double at) { return std::sinh(at); }))};
    case Operation::hyperbolic_tangent: {
      const Interval value = rising(x, [](double at) { return std::tanh(at); });
      return {value, chained(a, sum(one, negative(square(value))))};
    }
    case Operation::exponential: {
      const Interval value = rising(x, [](double at) { return std::exp(at); });
      return {value, chained(a, value)};
    }
    case Operation::logarithm:
      return {logarithm(x), chained(a, inverse(clipped(x, 0.0, kInfinity)))};
    case Operation::square_root: {
      const Interval value = square_root(x);
      return {value, chained(a, product({0.5, 0.5}, inverse(value)))};
    }
    case Operation::square_root_above_one: {
      const Interval root = square_root(sum(one, x));
      return {sum(root, {-1.0, -1.0}), chained(a, product({0.5, 0.5}, inverse(root)))};
    }
    default:
      throw std::logic_error("no smooth operation");
  }
}

}  // namespace

Interval Interval::all() { return {-kInfinity, kInfinity}; }

bool Interval::is_finite() const { return std::isfinite(low) && std::isfinite(high); }

Interval rounded(double low, double high) {
  const double below = low - kRounding * std::fabs(low);
  const double above = high + kRounding * std::fabs(high);
  if (std::isnan(below) || std::isnan(above)) return Interval::all();
  return {below, above};
}

Enclosure operator-(const Enclosure& a) { return {negative(a.value), negative(a.slope)}; }
Enclosure operator+(const Enclosure& a, const Enclosure& b) {
  return {sum(a.value, b.value), sum(a.slope, b.slope)};
}
Enclosure operator-(const Enclosure& a, const Enclosure& b) { return a + (-b); }

Enclosure enclose(Operation operation, const Enclosure& a, const Enclosure& b) {
  switch (operation) {
    case Operation::negate:
      return -a;
    case Operation::add:
      return a + b;
    case Operation::subtract:
      return a - b;
    case Operation::multiply:
      return multiply(a, b);
    case Operation::divide:
      return multiply(a, invert(b));
    case Operation::power:
      return raise(a, b);
    case Operation::arctangent_of_two:
      return angle_of(a, b);
    default:
      return enclose_function(operation, a);
  }
}

}  // namespace gearsweep
