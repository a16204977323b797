// The mesh of a planet and a ring gear.
#pragma once

namespace gearsweep {

// Lengths in mm, of the transverse section.
struct RingPair {
  double planet_teeth = 0.0, ring_teeth = 0.0;
  double reference = 0.0;                   // radius of the reference circle, for each tooth
  double alpha = 0.0;                       // transverse pressure angle of the tool, rad
  double centre = 0.0;                      // centre distance
  double planet_tip = 0.0, ring_tip = 0.0;  // radii
};

// The path of contact, in base pitches. It begins at the tips of the ring. Not a number where the
// tips do not meet the line of action.
struct RingContact {
  double before = 0.0, after = 0.0;  // the pitch point
  // Before it up to where the line of action touches the planet's base circle: the ring's tips must
  // not reach further (interference).
  double most_before = 0.0;
  double ratio() const { return before + after; }
  double approach() const { return before / ratio(); }
  bool interferes() const { return before > most_before * (1.0 + 1e-9); }
  // The path lies on both sides of the pitch point, and its length is one that the models take.
  bool is_usable() const;
};

RingContact ring_contact(const RingPair& pair);

}  // namespace gearsweep
