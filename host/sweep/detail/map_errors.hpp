// How far the maps of a run are from those of a run with shorter steps, at their periodic points.
//
// An error is relative to the range of its map, or to what is larger and knows no offset either: of
// a map that looks at a state or signal, the range of that in the motion; of others, which have a
// zero of their own (exponents, shares), their size. A map that is the same everywhere, to
// rounding, is judged by its size. So neither units nor offsets matter. Of a map of classes an
// error is 0 or
// 1. Samples of sections count as two maps for each state, the smallest and
// the largest sample. Left out are attractors' numbers, which mean nothing beside another run's,
// quantities that are errors themselves, and how many periods a motion took to settle: that is a
// whole number, which rounding changes by one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "engine/result.hpp"

namespace gearsweep {

// What an error may be, as a share of its map's range.
struct Tolerances {
  double maps;
  double exponents;  // of Lyapunov exponents, and of what is made of them
};

// The map whose error is the largest in terms of what it may be.
struct FurthestMap {
  std::string quantity;  // empty for samples, and where there is no map
  bool is_exponent = false;
  double error = 0.0, tolerance = 1.0;
  bool is_kept() const { return error <= tolerance; }
  double excess() const { return error / tolerance; }
};

// Whether a map is one of Lyapunov exponents, or made of them.
bool is_exponent(const Quantity& quantity);

class MapErrors {
 public:
  // Compares two runs over the same points. Ranges and periodic points are those of `fine`; a point
  // that is periodic in `coarse` and diverges in `fine` is judged, too. motion_ranges: of states
  // and signals along the motions, by name (study/own_step.hpp).
  MapErrors(const SweepResult& coarse, const SweepResult& fine, const Tolerances& tolerances,
            const std::map<std::string, double>& motion_ranges = {});

  // Of all other maps.
  MapErrors without_exponents() const;
  // Points that stopped on a periodic orbit in the run with shorter steps.
  std::size_t points() const { return points_; }
  // How many of these are beyond the tolerance: in the map that has most, and in any map.
  std::size_t beyond() const;
  std::size_t beyond_in_any() const;
  // By quantity, of those that are compared: the error that all but this share of the points keep.
  std::map<std::string, double> of_quantities(double share) const;
  // The largest of these, samples of sections included; 0 where there is none.
  double largest(double share) const;
  FurthestMap furthest(double share) const;
  // Whether the points that are not periodic look the same: the mean of each map over them is, to
  // the tolerance or to three standard errors, and no more than `share` of them have a
  // number in one of the runs alone, as where long steps diverge.
  bool others_agree(double share) const;
  // The points that no shorter step brings to within the tolerance, as a share of the periodic
  // ones. The pairs of runs are in the order of their steps, each step half of the one before. A
  // point is sensitive when it is beyond the tolerance between the last two runs, and its error has
  // fallen to there from no earlier pair: where a shorter step helps, errors are of first order at
  // least, and without that they stay what they are. The line is drawn between, at order one half.
  // An error of a map's whole range is as bad as any. Of the map that has most such points.
  static double sensitive_share(const std::vector<MapErrors>& halvings);

 private:
  struct Map {
    std::string quantity;  // empty for samples
    bool is_exponent = false;
    double tolerance = 0.0;
    std::vector<double> errors;          // [point]
    std::vector<double> ascending;       // at periodic points
    double mean = 0.0, deviation = 0.0;  // mean difference at the others, and its standard error
    double missing = 0.0;                // share of the others with a number in one run alone
  };
  std::vector<std::uint8_t> is_judged_;  // [point]
  std::size_t points_ = 0;
  std::vector<Map> maps_;
};

}  // namespace gearsweep
