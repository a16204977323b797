// A number that counts the floating-point operations done on it.
#pragma once

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

namespace gearsweep {

// The operations seen so far. Each of + - * / sqrt abs counts 1, and so does a comparison (of a
// lane-wise min or max; choosing by it is free, as is a change of sign), so that a fused
// multiply-add is 2. An operation that was seen before counts nothing: a compiler need not repeat
// it. Operations are the same when operator and operand values are, so the inputs must be generic.
class Tally {
 public:
  void see(char operation, double a, double b) { seen_.emplace(operation, a, b); }
  double flops() const { return static_cast<double>(seen_.size()); }

 private:
  std::set<std::tuple<char, double, double>> seen_;
};

// Numbers without a tally do not change in time, and nothing counts what is done with them alone: a
// compiler takes that out of the loop.
template <int bits>
class Counted {
 public:
  static constexpr int kBits = bits;  // of the device's number that it stands for

  Counted() = default;
  Counted(double value, Tally* tally = nullptr) : value_(value), tally_(tally) {}

  Counted operator-() const { return {-value_, tally_}; }
  friend Counted operator+(const Counted& a, const Counted& b) {
    const auto [low, high] = std::minmax(a.value_, b.value_);
    return see('+', low, high, a.value_ + b.value_, a, b);
  }
  friend Counted operator-(const Counted& a, const Counted& b) {
    return see('-', a.value_, b.value_, a.value_ - b.value_, a, b);
  }
  friend Counted operator*(const Counted& a, const Counted& b) {
    const auto [low, high] = std::minmax(a.value_, b.value_);
    return see('*', low, high, a.value_ * b.value_, a, b);
  }
  friend Counted operator/(const Counted& a, const Counted& b) {
    return see('/', a.value_, b.value_, a.value_ / b.value_, a, b);
  }
  friend bool operator<(const Counted& a, const Counted& b) {
    return see('<', a.value_, b.value_, 0.0, a, b), a.value_ < b.value_;
  }
  friend Counted sqrt(const Counted& a) {
    return see('s', a.value_, 0.0, std::sqrt(a.value_), a, a);
  }
  friend Counted fabs(const Counted& a) {
    return see('a', a.value_, 0.0, std::fabs(a.value_), a, a);
  }

 private:
  static Counted see(char operation, double x, double y, double result, const Counted& a,
                     const Counted& b) {
    Tally* const tally = a.tally_ != nullptr ? a.tally_ : b.tally_;
    if (tally != nullptr) tally->see(operation, x, y);
    return {result, tally};
  }

  double value_ = 0.0;
  Tally* tally_ = nullptr;
};

}  // namespace gearsweep
