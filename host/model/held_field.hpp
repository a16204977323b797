// The field of a model whose equations jump with a state, on the sides of its surfaces and of the
// limits of its contacts that a motion is on, and along the surfaces that it slides along (A. F.
// Filippov, Differential Equations with Discontinuous Righthand Sides, 1988). Where a state is
// reset, impacts that follow each other ever faster end in contact: the motion rests on the surface
// while it is pushed against it.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "model/contact_field.hpp"
#include "model/model.hpp"

namespace gearsweep {

// A state, and its tangent vectors, one a column.
struct HeldMotion {
  Eigen::VectorXd state;
  Eigen::MatrixXd tangents;
};

// coefs: one row of phase coefficients.
class HeldField {
 public:
  // Both must outlive it. It sets the sides that the point holds.
  HeldField(const Model& model, PreparedPoint* point);

  // Sets the sides by a state alone. On a surface, that is, nearer to it than a billionth of what
  // its level changes in `step` (dimensionless time), the fields of both sides decide: where both
  // lead to one side, that one; where both push towards it, the motion slides; where both lead
  // away, it goes on above. Before it has been called no side is held: the field is that of the
  // state's own sides.
  void begin(const double* coefs, double step, const double* x);

  // As PreparedPoint has them.
  void rhs(const double* coefs, const double* x, double* dx);
  void jacobian(const double* coefs, const double* x, double* out);
  // Where a motion slides, with the sides that its field mixes.
  void signals(const double* coefs, const double* x, double* out);

  // The levels of all surfaces, their rates along the motion, and the sizes of their terms, which
  // say how large rounding is.
  struct Levels {
    std::vector<double> value, rate, size;
  };
  Levels levels(const double* coefs, const double* x);

  // How far a motion is from leaving a side that it is on: below 0, and not a number, it has left
  // it. Each in a unit of its own: of surfaces their levels, of what it slides along the shares of
  // the fields of both sides, of the limits of contacts, which come after all surfaces, the depths.
  struct Clearance {
    std::size_t surface;
    double value;
  };
  // One for each surface that it may leave; as many, in the same order, until it passes a surface.
  const std::vector<Clearance>& clearances(const double* coefs, const double* x);
  // A surface on whose side a state is not any more, or along which it slid and does not; after
  // the surfaces, the limits of the contacts.
  std::optional<std::size_t> left_behind(const double* coefs, const double* x);
  // Goes on behind that surface; cuts: of the step, this one counted. Tangents jump by the
  // saltation matrix (R. I. Leine, H. Nijmeijer, Dynamics and Bifurcations of Non-Smooth Mechanical
  // Systems, 2004, chapter 7).
  void pass(std::size_t surface, const double* coefs, int cuts, HeldMotion* motion);

  // A contact on whose side a state is, or none: nothing jumps there, and the sides that are held
  // need not be its own for long.
  bool is_contact(std::size_t surface) const { return surface >= sides_.size(); }
  void hold_contacts(const double* coefs, const double* x);
  void free_contacts() { touches_.clear(); }
  // Its own sides, where a copy of it has held others of the same point since.
  void hold_again() { point_->hold(sides_); }

  bool slides() const;
  bool slides(std::size_t surface) const { return slides_[surface]; }
  // Takes a state that a step has led away from the surfaces that it slides along back onto them.
  void put_back(const double* coefs, double* x);
  // Takes from tangents what they have across the surfaces that the motion stays at: a neighbour
  // that lies off them by d comes to them in a time of order d. A tangent that is lost whole is 0.
  void settle(const double* coefs, HeldMotion* motion);
  // Surfaces that have reset the state since this was asked the last time, and the rates at which
  // their levels rose there.
  struct Met {
    std::size_t surface;
    double rate;
  };
  std::vector<Met> take_met() { return std::exchange(met_, {}); }
  // Whether it has begun to slide, or been reset, since this was asked the last time: tangents may
  // have been lost.
  bool take_slid();

 private:
  struct Sliding;
  struct Chain;
  // [surface]: where the state is to each, and what a motion at it holds.
  struct Held {
    std::vector<double> levels, rates;
  };
  // What resets make of tangent vectors, and of the field before them.
  struct Carried {
    Eigen::MatrixXd by;
    Eigen::VectorXd field;
  };

  // This value of all surfaces, so many numbers each.
  std::vector<double> values(SurfaceValue value, const double* coefs, const double* x,
                             std::size_t each) const;
  // How fast the levels change along dx.
  std::vector<double> rates(const double* coefs, const double* x, const double* dx) const;
  // How fast what a motion at this surface keeps changes along dx.
  double held_rate(std::size_t surface, const double* coefs, const double* x,
                   const double* dx) const;
  std::vector<double> field_with(const std::vector<double>& sides, const double* coefs,
                                 const double* x);
  std::vector<double> sides_below() const;
  Sliding sliding(const double* coefs, const double* x);
  void find_bound(Sliding* sliding) const;
  void bind(const double* coefs, const double* x);
  bool rests() const;  // against a surface where the state is reset
  // The level of a surface between two sides, of which this is the one above.
  double level_of(std::size_t surface, double above) const;
  // By the state alone, as begin() does; levels: of all surfaces.
  void find_sides(const std::vector<std::size_t>& surfaces, const std::vector<double>& levels,
                  const double* coefs, const double* x);
  void begin_at(std::size_t surface, double level, const double* coefs, const double* x);
  void cross(std::size_t surface, const double* coefs, const double* x);
  void reset_from(std::size_t surface, double rate, const double* coefs, double* x,
                  Carried* carried);
  Held held_at(const double* coefs, const double* x) const;
  void put_behind(std::size_t surface, const double* coefs, double* x, Carried* carried) const;
  std::optional<std::size_t> next_reset(const Held& before, const Held& now, const double* coefs,
                                        const double* x, Chain* chain);
  // rate_behind: of the level, as its own reset left it; level_there: how far off the surface it
  // still is where the motion came to it.
  void rebound(const Met& met, double rate_behind, double level_there, const double* coefs,
               double* x);
  // To just above or below a surface, at a level of `at`, so that by rounding it does not count as
  // on the other side; put_below: of one where the state is reset.
  void put_beside(std::size_t surface, double at, bool above, const double* coefs, double* x);
  void put_below(std::size_t surface, const double* coefs, double* x);
  // Below all that the motion rests against, at once: one after the other, each would lift the
  // state above the one before, where both move a mass between them.
  void put_below_all(const double* coefs, double* x);

  const Model& model_;
  PreparedPoint* point_;
  std::size_t states_;
  std::vector<double> sides_;  // of a jump that it slides along: the one above
  std::vector<bool> slides_;   // or stays at
  ContactField contacts_;
  HeldContacts touches_;  // empty: as the state has it
  std::vector<Clearance> clearances_;
  double step_ = 0.0;
  int cuts_ = 0;  // of the step, so far
  bool has_slid_ = false;
  std::vector<Met> met_;
};

}  // namespace gearsweep
