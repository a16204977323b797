// Intervals that hold all values of an expression while one variable runs through an interval: what
// they exclude is proven (Moore, Kearfott and Cloud, Introduction to Interval Analysis, 2009).
#pragma once

#include "expression/expression.hpp"

namespace gearsweep {

// Both ends included; they may be infinite.
struct Interval {
  double low = 0.0, high = 0.0;

  static Interval all();
  bool operator==(const Interval&) const = default;
  bool is_finite() const;
  bool contains(double value) const { return low <= value && value <= high; }
  double middle() const { return 0.5 * (low + high); }
};

// The values of an expression, and of its derivative by the variable. The derivative of what the
// variable does not change is [0, 0] exactly.
struct Enclosure {
  Interval value, slope;

  bool is_constant() const { return slope == Interval{}; }
};

Enclosure operator-(const Enclosure& a);
Enclosure operator+(const Enclosure& a, const Enclosure& b);
Enclosure operator-(const Enclosure& a, const Enclosure& b);

// What operations without conditions, corners and jumps make of enclosures: arithmetic, powers and
// the smooth functions. b: of those that have one argument ignored. A square, a * a, is one where
// both are the same object.
Enclosure enclose(Operation operation, const Enclosure& a, const Enclosure& b);

// A little wider than [low, high]: by more than the error of a number that was rounded or that a
// mathematical function gave. All numbers where one is NaN.
Interval rounded(double low, double high);

}  // namespace gearsweep
