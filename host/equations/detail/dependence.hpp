// What the nodes of a formula change with.
#pragma once

#include <map>
#include <vector>

#include "equations/detail/formula.hpp"

namespace gearsweep {

struct Dependence {
  bool state = false, phase = false;
  bool velocity = false;  // the second half of the states, where it is the first half's slope
  bool swept = false;     // a parameter that differs from point to point
  bool rounds = false;    // devices may give other last digits than the host does
};

class Dependences {
 public:
  // The formula outlives it; its graph may grow.
  explicit Dependences(const Formula& formula) : formula_(formula) {}

  // From here on, before anything is asked for: the second half of the states are velocities.
  void know_velocities() { has_velocities_ = true; }

  // These symbols change with the states.
  void know_sides(const std::vector<NodeId>& sides) { sides_ = sides; }

  const Dependence& of(NodeId id);

 private:
  Dependence of_symbol(NodeId id) const;
  bool is_swept(NodeId id) const;

  const Formula& formula_;
  bool has_velocities_ = false;
  std::vector<NodeId> sides_;
  std::map<NodeId, Dependence> known_;
};

}  // namespace gearsweep
