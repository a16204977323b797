// A model that is text at one setting, as the host works it out.
#pragma once

#include <memory>
#include <vector>

#include "equations/detail/tapes.hpp"

namespace gearsweep {

class TextPoint final : public PreparedPoint {
 public:
  TextPoint(std::shared_ptr<const Tapes> tapes, const ModelSetting& setting);

  double period() const override { return period_; }
  void rhs(const double* coefs, const double* x, double* dx) const override;
  void jacobian(const double* coefs, const double* x, double* out) const override;
  void signals(const double* coefs, const double* x, double* out) const override;
  void contact_places(const double* coefs, const double* x, double* out) const override;
  void force_direction(std::size_t contact, const double* coefs, const double* x,
                       double* out) const override;
  void force_direction_slope(std::size_t contact, const double* coefs, const double* x,
                             double* out) const override;
  void penetration_gradient(const ContactLimit& limit, const double* coefs, const double* x,
                            double* out) const override;
  void hold(const std::vector<double>& sides) override { sides_ = sides; }
  void of_surfaces(SurfaceValue value, const double* coefs, const double* x,
                   double* out) const override;

 private:
  void run(const Tape& tape, const double* coefs, const double* x, double* out) const;

  std::shared_ptr<const Tapes> tapes_;
  double period_ = 0.0;
  std::vector<double> sides_;   // that are held; empty: those that a state is on
  std::vector<double> moment_;  // of what a tape takes: states, sides, point; coefs are not here
};

}  // namespace gearsweep
