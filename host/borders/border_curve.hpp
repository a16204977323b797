// Follows a border through the plane of two parameters by pseudo-arclength continuation, both ways
// from a point of it, and names the points at which something else bifurcates, too (Y. A.
// Kuznetsov, Elements of Applied Bifurcation Theory, chapter 9).
#pragma once

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
  corner,         // the curve bends: the orbit touches a limit there that it did not touch before
};

// "cusp", "resonance 1:1", "fold-flip", "with a Neimark-Sacker pair", "corner".
std::string name_of(SpecialKind kind);

// Between two neighbours of the curve, on the straight line through both.
struct SpecialPoint {
  SpecialKind kind = SpecialKind::cusp;
  PlanePlace place{};
};

struct BorderCurve {
  BorderKind kind = BorderKind::fold;
  std::size_t period = 1;  // of the orbit that bifurcates, in forcing periods
  std::vector<BorderPoint> points;
  bool is_closed = false;
  std::string begins, ends;  // why, in words: "leaves the window"
  std::vector<SpecialPoint> special;

  double max_residual() const;
};

// Points of the curve lie at most this share of the window apart.
inline constexpr double kMaxCurveStep = 0.02;

BorderCurve follow_border(const BorderEquations& equations, const BorderPoint& start);

}  // namespace gearsweep
