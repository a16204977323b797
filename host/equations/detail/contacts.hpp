// The backlashes and stops of a model, then its other corners, as what corrects the steps that
// cross their limits wants them (kernels/rk4/crossing.h).
#pragma once

#include <map>
#include <string>
#include <vector>

#include "equations/detail/formula.hpp"

namespace gearsweep {

struct Contact {
  std::string name;                     // of its quantities; empty where it is the only one
  NodeId corner = 0;                    // the backlash or stop
  NodeId penetration = 0;               // the symbol for it in Contacts::equations
  NodeId deflection = 0, backlash = 0;  // of states, point and phase
  bool is_one_sided = false;
  // No backlash or stop, and nobody looks at it: it has neither corner nor penetration, is
  // one-sided, and its name is the expression that bends.
  bool is_hidden = false;
  bool may_be_negative = true;  // the backlash: then both flanks may touch at once
  // How the equations change with the penetration where that begins: [state]. All 0 where that is
  // not finite, as with the square root of a penetration; such a contact is not corrected.
  std::vector<NodeId> direction;
};

struct Contacts {
  std::vector<Contact> list;      // hidden ones last
  std::vector<NodeId> equations;  // where the penetrations are known
  std::vector<NodeId> along;      // symbols: a force's direction, [state]
  // How the equations change along it.
  std::vector<NodeId> carried;
  // How each contact's deflection and backlash do; all 0 in most models.
  std::vector<NodeId> deflection_along, backlash_along;
  bool has_feedback = false;      // these are not all 0
  bool direction_varies = false;  // with a state
};

// Whether nothing in these divides by what is always 0.
bool stay_finite(const ExpressionGraph& graph, const std::vector<NodeId>& values);

// equations: of the inner loop. names: of the constants that hold a corner. hidden: in terms of the
// inner loop.
Contacts find_contacts(Formula* formula, const std::vector<NodeId>& equations,
                       const std::map<NodeId, std::string>& names,
                       const std::vector<Contact>& hidden);

}  // namespace gearsweep
