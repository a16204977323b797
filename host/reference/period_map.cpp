#include "reference/period_map.hpp"

#include "sweep_types.h"

namespace gearsweep {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

bool in_range(const VectorXd& state) {
  return state.allFinite() && state.cwiseAbs().maxCoeff() < SWEEP_DIVERGED_BEYOND;
}

// Advances a state. Keeps its vectors from step to step: allocating them anew costs more than a
// small model's right-hand side.
class Stepper {
 public:
  Stepper(const PreparedPoint& point, std::size_t row_width, const VectorXd& state)
      : state_(state), point_(point), row_width_(row_width), at_(state), sum_(state), k_(state) {}
  virtual ~Stepper() = default;

  // `coefs`: the rows at the step's start, middle and end.
  void step(const double* coefs, double h) {
    const double* const middle = coefs + row_width_;
    stage(coefs, state_, 0.0, h / 6.0, true);
    at_ = state_ + 0.5 * h * k_;
    stage(middle, at_, 0.5 * h, h / 3.0, false);
    at_ = state_ + 0.5 * h * k_;
    stage(middle, at_, 0.5 * h, h / 3.0, false);
    at_ = state_ + h * k_;
    stage(middle + row_width_, at_, h, h / 6.0, false);
    state_ += sum_;
    finish();
  }
  const VectorXd& state() const { return state_; }

 protected:
  // The derivative of a stage whose state is the step's first plus `reach` times the last slope.
  virtual void differentiate(const double*, const VectorXd&, double /*reach*/, double /*weight*/,
                             bool /*first*/) {}
  virtual void finish() {}
  const PreparedPoint& point() const { return point_; }

 private:
  void stage(const double* coefs, const VectorXd& at, double reach, double weight, bool first) {
    differentiate(coefs, at, reach, weight, first);
    point_.rhs(coefs, at.data(), k_.data());
    if (first) {
      sum_ = weight * k_;
    } else {
      sum_ += weight * k_;
    }
  }

  VectorXd state_;
  const PreparedPoint& point_;
  std::size_t row_width_;
  VectorXd at_, sum_, k_;
};

// Advances the derivative by the first state, too.
class TangentStepper final : public Stepper {
 public:
  TangentStepper(const PreparedPoint& point, std::size_t row_width, const VectorXd& state)
      : Stepper(point, row_width, state),
        jacobian_(state.size(), state.size()),
        matrix_(MatrixXd::Identity(state.size(), state.size())),
        at_(matrix_),
        sum_(matrix_),
        k_(matrix_) {}
  const MatrixXd& matrix() const { return matrix_; }

 private:
  void differentiate(const double* coefs, const VectorXd& at, double reach, double weight,
                     bool first) override {
    point().jacobian(coefs, at.data(), jacobian_.data());
    if (first) {
      k_.noalias() = jacobian_ * matrix_;
      sum_ = weight * k_;
    } else {
      at_ = matrix_ + reach * k_;
      k_.noalias() = jacobian_ * at_;
      sum_ += weight * k_;
    }
  }
  void finish() override { matrix_ += sum_; }

  RowMatrix jacobian_;
  MatrixXd matrix_, at_, sum_, k_;
};

}  // namespace

PeriodMap::PeriodMap(const Model& model, const ModelSetting& setting, std::size_t steps)
    : grid_(make_phase_grid(model, setting, steps)),
      row_width_(model.phase_coefs.size()),
      point_(model.prepare(setting)) {}

bool PeriodMap::driven() const {
  for (std::size_t i = row_width_; i < grid_.coefs.size(); ++i) {
    if (grid_.coefs[i] != grid_.coefs[i - row_width_]) return true;
  }
  return false;
}

template <class Step>
void PeriodMap::each_step(const Step& step) const {
  const double* coefs = grid_.coefs.data();
  for (std::size_t segment = 0; segment < grid_.segment_steps.size(); ++segment) {
    const double h = grid_.segment_fractions[segment] * point_->period();
    for (std::uint32_t i = 0; i < grid_.segment_steps[segment]; ++i) {
      step(coefs, h);
      coefs += 2 * row_width_;
    }
    coefs += row_width_;  // the next segment has its own one-sided row at the break phase
  }
}

std::optional<VectorXd> PeriodMap::advance(const VectorXd& state, std::size_t periods) const {
  Stepper stepper(*point_, row_width_, state);
  for (std::size_t i = 0; i < periods; ++i) {
    each_step([&](const double* coefs, double h) { stepper.step(coefs, h); });
    if (!in_range(stepper.state())) return std::nullopt;
  }
  return stepper.state();
}

std::optional<PeriodImage> PeriodMap::linearize(const VectorXd& state, std::size_t periods) const {
  TangentStepper stepper(*point_, row_width_, state);
  for (std::size_t i = 0; i < periods; ++i) {
    each_step([&](const double* coefs, double h) { stepper.step(coefs, h); });
    if (!in_range(stepper.state())) return std::nullopt;
  }
  return PeriodImage{stepper.state(), stepper.matrix()};
}

}  // namespace gearsweep
