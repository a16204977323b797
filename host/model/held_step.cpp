#include "model/held_step.hpp"

#include <algorithm>
#include <limits>

namespace gearsweep {
namespace {

constexpr int kMaxParts = 512;  // of a step
constexpr int kLooks = 4;       // so that a surface that is crossed and crossed back is seen

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

class Step {
 public:
  Step(HeldField* field, const StepMoments& moment_at) : field_(field), moment_at_(moment_at) {}

  void take(double from, double to, HeldMotion* motion) const {
    carry_held(field_, moment_at_, from, to, motion);
    field_->put_back(moment_at_(to).data(), motion->state.data());
  }

  // The share at which the motion is just beyond the first surface; 1 where there is none.
  double first_event(double from, const HeldMotion& start) const {
    double low = from;
    for (int look = 1; look <= kLooks; ++look) {
      double high = look == kLooks ? 1.0 : from + (1.0 - from) * look / kLooks;
      if (!is_left_behind(from, high, start)) {
        low = high;
        continue;
      }
      for (double middle = 0.5 * (low + high); low < middle && middle < high;
           middle = 0.5 * (low + high)) {
        (is_left_behind(from, middle, start) ? high : low) = middle;
      }
      return high;
    }
    return 1.0;
  }

 private:
  bool is_left_behind(double from, double to, const HeldMotion& start) const {
    HeldMotion probe{start.state, Eigen::MatrixXd(start.state.size(), 0)};
    take(from, to, &probe);
    return field_->left_behind(moment_at_(to).data(), probe.state.data()).has_value();
  }

  HeldField* field_;
  const StepMoments& moment_at_;
};

}  // namespace

std::vector<double> StepMoments::operator()(double share) const {
  std::vector<double> coefs(width);
  (*row_at)(std::min(phase + share * length, 1.0), inside, coefs.data());
  return coefs;
}

void carry_held(HeldField* field, const StepMoments& moment_at, double from, double to,
                HeldMotion* motion) {
  const double h = (to - from) * moment_at.length * moment_at.period;
  const std::vector<double> middle = moment_at(0.5 * (from + to));
  HeldMotion at = *motion, slope = *motion, sum = *motion;
  RowMajor jacobian(at.state.size(), at.state.size());
  // Adds the slope at a moment to the sum, and goes to where the next one is looked for.
  const auto add = [&](const std::vector<double>& coefs, double weight, double reach) {
    field->rhs(coefs.data(), at.state.data(), slope.state.data());
    sum.state += h * weight * slope.state;
    if (at.tangents.cols() > 0) {
      field->jacobian(coefs.data(), at.state.data(), jacobian.data());
      slope.tangents.noalias() = jacobian * at.tangents;
      sum.tangents += h * weight * slope.tangents;
      at.tangents = motion->tangents + h * reach * slope.tangents;
    }
    at.state = motion->state + h * reach * slope.state;
  };
  add(moment_at(from), 1.0 / 6.0, 0.5);
  add(middle, 1.0 / 3.0, 0.5);
  add(middle, 1.0 / 3.0, 1.0);
  add(moment_at(to), 1.0 / 6.0, 0.0);
  *motion = std::move(sum);
}

void step_held(HeldField* field, const StepMoments& moment_at, HeldMotion* motion,
               const PartCallback& each_part) {
  const Step step(field, moment_at);
  double from = 0.0;
  for (int part = 0; part < kMaxParts; ++part) {
    field->settle(moment_at(from).data(), motion);
    const HeldMotion before = *motion;
    const double to = step.first_event(from, before);
    step.take(from, to, motion);
    if (each_part) each_part(from, to, before, *motion);
    const std::vector<double> coefs = moment_at(to);
    const auto surface = field->left_behind(coefs.data(), motion->state.data());
    if (surface) field->pass(*surface, coefs.data(), part + 1, motion);
    if (to == 1.0) return;
    from = to;
  }
  motion->state.setConstant(std::numeric_limits<double>::quiet_NaN());
}

}  // namespace gearsweep
