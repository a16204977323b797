#include "reference/detail/zero_one_observable.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

namespace gearsweep {
namespace {

double correlation(const Eigen::ArrayXd& a, const Eigen::ArrayXd& b) {
  const Eigen::ArrayXd from_a = a - a.mean();
  const Eigen::ArrayXd from_b = b - b.mean();
  return (from_a * from_b).sum() / std::sqrt(from_a.square().sum() * from_b.square().sum());
}

// Where the walk stands at first and after each sample.
Eigen::ArrayXcd walk(const Eigen::ArrayXd& series, double angle) {
  Eigen::ArrayXcd places(series.size() + 1);
  places[0] = 0.0;
  for (Eigen::Index j = 1; j <= series.size(); ++j) {
    places[j] = places[j - 1] + std::polar(1.0, angle * static_cast<double>(j)) * series[j - 1];
  }
  return places;
}

// K_c of a series of mean 0.
double growth_of_walk(const Eigen::ArrayXd& series, double angle) {
  const Eigen::ArrayXcd places = walk(series, angle);
  const Eigen::Index lags = std::min<Eigen::Index>(series.size() / 10, 128);
  const Eigen::Index starts = series.size() - lags;
  Eigen::ArrayXd displacement(lags);
  for (Eigen::Index n = 1; n <= lags; ++n) {
    displacement[n - 1] = (places.segment(n, starts) - places.head(starts)).abs2().mean();
  }
  return correlation(Eigen::ArrayXd::LinSpaced(lags, 1.0, static_cast<double>(lags)), displacement);
}

class ZeroOne final : public ReferenceObservable {
 public:
  ZeroOne(double tolerance, const StateKinds& kinds)
      : tolerance_(tolerance), range_(kinds, tolerance) {}
  void begin(const Eigen::VectorXd& state) override { range_.begin(state); }
  void step(const TrajectoryStep& step) override { range_.widen(step.after.state); }
  void period(const Eigen::VectorXd& state, const Eigen::VectorXd&, double) override {
    samples_.push_back(state[0]);
    range_.end_period(state);
  }

  std::vector<double> finish(const Window&) const override {
    if (samples_.size() < 100) return {std::numeric_limits<double>::quiet_NaN()};
    const Eigen::Map<const Eigen::ArrayXd> samples(samples_.data(),
                                                   static_cast<Eigen::Index>(samples_.size()));
    const Eigen::ArrayXd series = samples - samples.mean();
    const double deviation = std::sqrt(series.square().mean());
    if (deviation <= tolerance_ * range_.of_state(0)) return {0.0};
    constexpr std::size_t kAngles = 31;
    std::vector<double> answers;
    for (std::size_t i = 1; i <= kAngles; ++i) {
      const double turns = static_cast<double>(i) / std::numbers::phi;
      const double angle = std::numbers::pi / 5.0 * (1.0 + 3.0 * (turns - std::floor(turns)));
      answers.push_back(growth_of_walk(series, angle));
    }
    const auto middle = answers.begin() + kAngles / 2;
    std::nth_element(answers.begin(), middle, answers.end());
    return {*middle};
  }

 private:
  double tolerance_;
  MotionRange range_;
  std::vector<double> samples_;
};

}  // namespace

std::unique_ptr<ReferenceObservable> make_zero_one(double tolerance, const StateKinds& kinds) {
  return std::make_unique<ZeroOne>(tolerance, kinds);
}

}  // namespace gearsweep
