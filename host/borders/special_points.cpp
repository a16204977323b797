// The special points of curves, and what they and grazes are called.
#include <algorithm>
#include <cmath>

#include "borders/border_curve.hpp"

namespace gearsweep {
namespace {

int real_beyond(const BorderPoint& point, double sign) {
  return static_cast<int>(std::ranges::count_if(
      point.multipliers, [&](const auto& m) { return m.imag() == 0.0 && sign * m.real() > 1.0; }));
}

// How many pairs lie outside the circle.
int pairs_beyond(const BorderPoint& point) {
  return static_cast<int>(std::ranges::count_if(
      point.multipliers, [](const auto& m) { return m.imag() > 0.0 && std::abs(m) > 1.0; }));
}

// Adds the special points between two neighbours.
void add_special(const BorderPoint& a, const BorderPoint& b, BorderCurve* curve) {
  const auto add = [&](SpecialKind kind, double share) {
    SpecialPoint special{kind, {}};
    for (std::size_t i = 0; i < 2; ++i) {
      special.place[i] = a.place[i] + share * (b.place[i] - a.place[i]);
    }
    curve->special.push_back(special);
  };
  const auto where_zero = [&](double before, double after, SpecialKind kind) {
    if ((before < 0.0) != (after < 0.0)) add(kind, before / (before - after));
  };
  const auto where_counted = [&](int before, int after, SpecialKind kind) {
    if (before != after) add(kind, 0.5);
  };
  switch (curve->kind) {
    case BorderKind::grazing:
      where_counted(real_beyond(a, 1.0), real_beyond(b, 1.0), SpecialKind::graze_fold);
      where_counted(real_beyond(a, -1.0), real_beyond(b, -1.0), SpecialKind::graze_flip);
      where_counted(pairs_beyond(a), pairs_beyond(b), SpecialKind::graze_neimark);
      return;
    case BorderKind::symmetry_breaking:
      where_zero(a.overlap, b.overlap, SpecialKind::resonance_1_1);
      where_counted(pairs_beyond(a), pairs_beyond(b), SpecialKind::fold_neimark);
      return;
    case BorderKind::fold:
      where_zero(a.fold_bend, b.fold_bend, SpecialKind::cusp);
      where_zero(a.overlap, b.overlap, SpecialKind::resonance_1_1);
      where_counted(real_beyond(a, -1.0), real_beyond(b, -1.0), SpecialKind::fold_flip);
      where_counted(pairs_beyond(a), pairs_beyond(b), SpecialKind::fold_neimark);
      return;
    case BorderKind::flip:
      where_zero(a.overlap, b.overlap, SpecialKind::resonance_1_2);
      where_counted(real_beyond(a, 1.0), real_beyond(b, 1.0), SpecialKind::fold_flip);
      where_counted(pairs_beyond(a), pairs_beyond(b), SpecialKind::fold_neimark);
      return;
    case BorderKind::neimark_sacker:
      where_zero(std::cos(a.angle) + 0.5, std::cos(b.angle) + 0.5, SpecialKind::resonance_1_3);
      where_zero(std::cos(a.angle), std::cos(b.angle), SpecialKind::resonance_1_4);
      where_counted(real_beyond(a, 1.0), real_beyond(b, 1.0), SpecialKind::fold_neimark);
      where_counted(real_beyond(a, -1.0), real_beyond(b, -1.0), SpecialKind::fold_neimark);
      return;
  }
}

}  // namespace

void add_special_points(BorderCurve* curve) {
  for (std::size_t i = 0; i + 1 < curve->points.size(); ++i) {
    add_special(curve->points[i], curve->points[i + 1], curve);
  }
}

std::string name_of(CurveEnd end) {
  switch (end) {
    case CurveEnd::window:
      return "leaves the window";
    case CurveEnd::closes:
      return "closes";
    case CurveEnd::settles_no_more:
      return "no motion that settles grazes from here on";
    case CurveEnd::resonance_1_1:
      return "ends at a resonance 1:1";
    case CurveEnd::resonance_1_2:
      return "ends at a resonance 1:2";
    case CurveEnd::too_long:
      return "stopped: too many points";
    case CurveEnd::no_way_on:
      break;
  }
  return "no way on";
}

std::string name_of(SpecialKind kind) {
  switch (kind) {
    case SpecialKind::cusp:
      return "cusp";
    case SpecialKind::resonance_1_1:
      return "resonance 1:1";
    case SpecialKind::resonance_1_2:
      return "resonance 1:2";
    case SpecialKind::resonance_1_3:
      return "resonance 1:3";
    case SpecialKind::resonance_1_4:
      return "resonance 1:4";
    case SpecialKind::fold_flip:
      return "fold-flip";
    case SpecialKind::fold_neimark:
      return "with a Neimark-Sacker pair";
    case SpecialKind::graze_fold:
      return "graze meets fold";
    case SpecialKind::graze_flip:
      return "graze meets flip";
    case SpecialKind::graze_neimark:
      return "graze meets Neimark-Sacker";
    case SpecialKind::corner:
      break;
  }
  return "corner";
}

std::string describe(const Model& model, const GrazedLimit& limit) {
  const Model& whole = model.full();
  const std::size_t surfaces = whole.surfaces.size();
  std::string what;
  if (limit.index < surfaces) {
    const SurfaceInfo& surface = whole.surfaces[limit.index];
    what = surface.name.empty() ? "the jump of " + surface.expression : surface.name;
  } else {
    const ContactLimit at = whole.contact_limits()[limit.index - surfaces];
    if (at.contact >= whole.contacts.size()) {
      what = "a corner of the equations";
    } else {
      const ContactInfo& contact = whole.contacts[at.contact];
      const bool has_flanks = !contact.is_one_sided;
      what = !has_flanks ? "the stop" : at.flank > 0.0 ? "the drive flank" : "the back flank";
      if (!contact.name.empty()) what += " of " + contact.name;
    }
  }
  return (limit.is_from_below ? "touches " : "leaves ") + what;
}

}  // namespace gearsweep
