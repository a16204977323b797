#include "plot/curve_styles.hpp"

#include <sstream>

namespace gearsweep {

std::vector<double> dash_lengths(const CurveStyle& style) {
  constexpr double kUnit = 0.4;  // of gnuplot's dashes, in widths of the line
  std::vector<double> out;
  std::istringstream text(style.dashes);
  char mark = 0;
  for (double length = 0.0; text >> mark && text >> length;) out.push_back(kUnit * length);
  return out;
}

std::vector<CurveStretch> stretches_of(const StoredCurve& curve) {
  std::vector<CurveStretch> out;
  for (std::size_t i = 0; i + 1 < curve.places.size(); ++i) {
    const bool is_stable = curve.is_stable[i] && curve.is_stable[i + 1];
    if (out.empty() || out.back().is_stable != is_stable) out.push_back({i, i + 1, is_stable});
    out.back().last = i + 1;
  }
  return out;
}

}  // namespace gearsweep
