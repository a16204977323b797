// A curve through measured points, once in each period of 2 pi.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace gearsweep {

struct TablePoint {
  double phase = 0.0;  // rad
  double value = 0.0;
  bool operator==(const TablePoint&) const = default;
};

enum class Interpolation : std::uint8_t {
  linear,
  cubic  // a spline: between two jumps one of its own, otherwise one that is periodic
};

const char* name_of(Interpolation interpolation);

// A value type.
class PeriodicTable {
 public:
  // points: from the first one to less than 2 pi behind it, with rising phases. Two of the same
  // phase are a jump from the first one's value to the second one's. name: of their file. Throws
  // InputError where they are too few.
  PeriodicTable(std::string name, const std::vector<TablePoint>& points,
                Interpolation interpolation);

  const std::string& name() const { return name_; }
  Interpolation interpolation() const { return interpolation_; }
  // Whether both have the same value at any phase, whatever their names.
  bool is_same_curve(const PeriodicTable& other) const;
  // Where it jumps: phases in radians.
  const std::vector<double>& jumps() const { return jumps_; }
  // Where a linear table's slope jumps and its value does not: phases in radians. Of a cubic one
  // none.
  std::vector<double> corners() const;

  // The value at any phase, in radians; at a jump that of the side on which `toward` lies, which is
  // a phase with no jump in between. NaN where a phase is not finite.
  double at(double phase, double toward) const;
  // The same curve times a factor.
  PeriodicTable times(double factor) const;
  // The second derivative of a cubic one without jumps, which is linear.
  PeriodicTable bend() const;
  // Bounds of the value and of the slope between two phases that no jump parts from `toward`.
  struct Range {
    double low, high, slope_low, slope_high;
  };
  Range range(double from, double to, double toward) const;

 private:
  struct Knot {
    double phase, value;
    double bend = 0.0;  // the second derivative
    bool operator==(const Knot&) const = default;
  };

  // Where a phase lies: as the shares a and b of the knots on both sides of it.
  struct KnotShares {
    const Knot* left;
    const Knot* right;
    double a, b;
  };
  KnotShares shares_at(double phase, double toward) const;
  KnotShares shares_in(std::size_t interval, double phase) const;
  static double value_at(const KnotShares& shares);
  static double slope_at(const KnotShares& shares);
  void take_in(double low, double high, Range* range) const;
  void take_in(std::size_t interval, double from, double to, Range* range) const;
  void bend_period();
  void bend_piece(std::size_t first, std::size_t last);

  std::string name_;
  Interpolation interpolation_;
  std::vector<Knot> knots_;  // of one period, both ends included; where there are jumps, from one
  std::vector<std::size_t> pieces_;  // the first knot of each piece without jumps, and the end
  std::vector<double> jumps_;
};

}  // namespace gearsweep
