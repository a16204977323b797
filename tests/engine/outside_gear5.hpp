// gear5 written a second time, from its published equations and not from the shared header, and
// integrated by Boost.odeint: the outside opinion on formula and trajectory.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "model/model.hpp"

namespace gearsweep::testing {

// x1..x5, x1'..x5', then the integrals of x1 and of x1^2 over the phase.
using OutsideState = std::array<double, 12>;

// What happens between the steps' ends, too: smallest and largest x1, and the shares of the periods
// during which the drive flank and the back flank touch.
struct OutsideRange {
  double min, max;
  double drive = 0.0, back = 0.0;
};

// Sums over the tooth pairs, by the names of the model's equations.
struct MeshSums {
  double B, G, H, Q, C;
};

class OutsideGear {
 public:
  explicit OutsideGear(const ModelSetting& setting);

  double period() const;

  // The pinion's tooth 0 loses the share `lost` of its pair's stiffness at a place on the path of
  // contact, 0 to 1; steps end where the curve bends.
  void damage_pinion(std::function<double(double)> lost, const std::vector<double>& bends);

  // At a phase of the forcing; the one inside is strictly between the break phases around it and
  // tells on which side of a break it is meant.
  MeshSums sums(double phase, double phase_inside) const;

  // The derivative by dimensionless time. The two integrals' derivatives are x1 and x1^2 divided by
  // the period.
  void slope(double psi, double inside, const OutsideState& x, OutsideState* dx) const;

  // One period from phase 0 by the controlled Dormand-Prince method of order 5, restarted at each
  // break phase. The tolerance is absolute and relative. `range` is widened by what happens.
  void advance_period(double tolerance, OutsideState* x, OutsideRange* range = nullptr) const;

 private:
  double deflection(const OutsideState& x) const;
  double backlash(const OutsideState& x) const;
  // Widens `range` by a step of length h, which Hermite's cubic follows to fourth order.
  void watch(const OutsideState& before, const OutsideState& after, double h,
             OutsideRange* range) const;
  double pair_stiffness(std::size_t pair, double psi, bool in_contact) const;
  // The stiffness of a pair at its position, where its mean over all positions is not yet known.
  double shape(double position) const;
  // What is left of it, at a place, of the pair that entered with a mesh period, by the numbers of
  // its teeth.
  double left_by_damage(long entered, double place) const;
  // The transmission error and its second derivative by the angle omega tau.
  struct Error {
    double value = 0.0, second = 0.0;
  };
  Error error(double psi) const;

  double omega_, b_, mu_, F1_, e0_, zeta_, m1_, m2_;
  std::array<double, 4> k_, c_;
  double eps_, engagement_, gripped_, pitch_point_, alpha_, A_, rho_p_, rho_g_, zp_, ratio_, q_,
      kappa_, phase_;
  std::string formulation_, stiffness_;
  bool dynamic_;
  double cycle_;
  struct Line {
    double amplitude, order, phase;
  };
  std::vector<Line> lines_;  // of the transmission error; orders by the mesh
  double damage_p_, damage_g_;
  std::function<double(double)> lost_;
  std::vector<double> breaks_;
};

// The ten states of the model as the start of an outside integration, integrals at zero.
OutsideState outside_state(const std::vector<double>& model_state);

}  // namespace gearsweep::testing
