// How border curves are drawn: told apart by their dashes, too, where there are no colours.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "result/border_file.hpp"

namespace gearsweep {

struct CurveStyle {
  const char* kind;    // name_of(BorderKind)
  const char* colour;  // as "#c8102e"
  const char* dashes;  // "1": none; else lengths and gaps, as "(14,4)"
};

inline constexpr std::array<CurveStyle, 5> kCurveStyles = {
    {{"grazing", "#00695c", "(12,6,2,6)"},
     {"fold", "#c8102e", "1"},
     {"flip", "#000000", "(14,4)"},
     {"Neimark-Sacker", "#7b2fd0", "(3,3)"},
     {"symmetry breaking", "#0d47a1", "(2,8)"}}};

// Widths of lines: of stable motions over a white rim, so that they are seen on any colour; thin
// and without dashes where no motion settles that bifurcates.
inline constexpr double kCurveWidth = 1.8, kCurveRimWidth = 3.4, kThinCurveWidth = 0.6;

// Lengths and gaps in widths of the line, for whoever does not draw with gnuplot; none: no dashes.
std::vector<double> dash_lengths(const CurveStyle& style);

// A stretch of a curve along which it is of stable motions, or of others. Neighbours share a point.
struct CurveStretch {
  std::size_t first = 0, last = 0;  // points of the curve
  bool is_stable = false;
};
std::vector<CurveStretch> stretches_of(const StoredCurve& curve);

}  // namespace gearsweep
