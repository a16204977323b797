// Follows a border through the plane of two parameters by pseudo-arclength continuation, both ways
// from a point of it, and names the points at which something else bifurcates, too (Y. A.
// Kuznetsov, Elements of Applied Bifurcation Theory, chapter 9).
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "borders/border.hpp"

namespace gearsweep {

// Special points of a curve.
enum class SpecialKind {
  cusp,           // of a fold: two folds meet
  resonance_1_1,  // two multipliers at +1
  resonance_1_2,  // two at -1
  resonance_1_3,  // of a Neimark-Sacker curve: its angle is a third of a turn
  resonance_1_4,  // a quarter
  fold_flip,      // multipliers at +1 and at -1
  fold_neimark,   // a pair on the circle, too: a fold, or a flip, meets a Neimark-Sacker curve
  graze_fold,     // of a grazing curve: a multiplier is at +1, too
  graze_flip,     // at -1
  graze_neimark,  // a pair is on the circle, too
  corner,         // the curve bends: the orbit touches a limit there that it did not touch before
};

// "cusp", "resonance 1:1", "fold-flip", "with a Neimark-Sacker pair", "graze meets fold", "corner".
std::string name_of(SpecialKind kind);

// Why a curve ends where it does.
enum class CurveEnd {
  window,
  no_way_on,
  closes,
  settles_no_more,
  resonance_1_1,
  resonance_1_2,
  too_long
};

// "leaves the window", "no way on", "closes", ...
std::string name_of(CurveEnd end);

// Between two neighbours of the curve, on the straight line through both.
struct SpecialPoint {
  SpecialKind kind = SpecialKind::cusp;
  PlanePlace place{};
};

struct BorderCurve {
  BorderKind kind = BorderKind::fold;
  std::size_t period = 1;  // of the orbit that bifurcates, in forcing periods
  GrazedLimit limit;       // of a grazing curve
  BorderScale scale;
  std::vector<BorderPoint> points;
  std::size_t start = 0;  // the point that it was followed from, both ways
  bool is_closed = false;
  CurveEnd begins = CurveEnd::no_way_on, ends = CurveEnd::no_way_on;
  std::vector<SpecialPoint> special;
  std::vector<BorderPoint> stops;  // where it was hard to go on: the orbit may graze a limit there

  // What is found out about it afterwards (curve_accuracy.hpp). step_error: how far it moves across
  // itself, in pixels of the map, where it is solved with twice the steps, at most; no number: not
  // known. gradients [parameter]: how far it moves across itself with each parameter of the model,
  // at the point `judged`; no number for the plane's own and for those that change nothing.
  double step_error = std::numeric_limits<double>::quiet_NaN();
  std::vector<PlanePlace> gradients;
  std::size_t judged = 0;

  double max_residual() const;
};

// Adds the special points between neighbours of the curve.
void add_special_points(BorderCurve* curve);

// What a motion does at a graze, as "touches the drive flank" or "leaves the wall".
std::string describe(const Model& model, const GrazedLimit& limit);

// Points of the curve lie at most this share of the window apart.
inline constexpr double kMaxCurveStep = 0.02;

BorderCurve follow_border(const BorderEquations& equations, const BorderPoint& start);

}  // namespace gearsweep
