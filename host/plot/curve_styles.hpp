// How border curves are drawn: told apart by their dashes, too, where there are no colours.
#pragma once

#include <array>

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

}  // namespace gearsweep
