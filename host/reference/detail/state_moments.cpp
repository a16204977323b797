#include "reference/detail/state_moments.hpp"

#include <Eigen/Core>
#include <cmath>
#include <numbers>
#include <vector>

namespace gearsweep {
namespace {

// All values are kept, each with its weight, and looked at once the mean is known.
class StateMoments final : public ReferenceObservable {
 public:
  explicit StateMoments(const Model& model)
      : is_autonomous_(model.is_autonomous), angles_(model.angles) {}

  void step(const TrajectoryStep& step) override {
    if (!is_autonomous_) return;
    keep(step.before.state, step.share / 6.0);
    keep(step.middle.state, step.share * 4.0 / 6.0);
    keep(step.after.state, step.share / 6.0);
  }
  void period(const Eigen::VectorXd& state, const Eigen::VectorXd&, double) override {
    if (!is_autonomous_) keep(state, 1.0);
    ends_.push_back(weights_.size());
  }
  std::vector<double> finish(const Window&) const override {
    if (ends_.empty()) {  // it diverged before
      return std::vector<double>(4 * values_.size(), std::numeric_limits<double>::quiet_NaN());
    }
    constexpr std::size_t kBlocks = 16;
    const std::size_t length = std::max<std::size_t>(ends_.size() / kBlocks, 1);
    const std::size_t blocks = ends_.size() / length;
    const std::size_t count = ends_[blocks * length - 1];
    const Eigen::Map<const Eigen::ArrayXd> weights(weights_.data(),
                                                   static_cast<Eigen::Index>(count));
    std::vector<double> out;
    std::vector<Eigen::ArrayXd> offsets;
    for (const std::vector<double>& values : values_) {
      const Eigen::Map<const Eigen::ArrayXd> x(values.data(), static_cast<Eigen::Index>(count));
      out.push_back((x * weights).sum() / weights.sum());
      offsets.emplace_back(x - out.back());
    }
    std::vector<double> mean_errors, errors;
    for (const Eigen::ArrayXd& offset : offsets) {
      const double deviation = std::sqrt((offset.square() * weights).sum() / weights.sum());
      out.push_back(deviation);
      mean_errors.push_back(error_of(offset, blocks, length));
      const double error = error_of(offset.square(), blocks, length);
      errors.push_back(deviation > 0.0 ? error / (2.0 * deviation) : 0.0);
    }
    out.insert(out.end(), mean_errors.begin(), mean_errors.end());
    out.insert(out.end(), errors.begin(), errors.end());
    return out;
  }

 private:
  void keep(const Eigen::VectorXd& state, double weight) {
    values_.resize(static_cast<std::size_t>(state.size()));
    for (std::size_t i = 0; i < values_.size(); ++i) {
      values_[i].push_back(state[static_cast<Eigen::Index>(i)]);
    }
    for (const std::size_t angle : angles_) {
      values_[angle].back() = std::remainder(values_[angle].back(), 2.0 * std::numbers::pi);
    }
    weights_.push_back(weight);
  }

  // The error of the mean of `values`, by the spread of the blocks' means.
  double error_of(const Eigen::ArrayXd& values, std::size_t blocks, std::size_t length) const {
    Eigen::ArrayXd means(static_cast<Eigen::Index>(blocks));
    std::size_t begin = 0;
    for (std::size_t block = 0; block < blocks; ++block) {
      const std::size_t end = ends_[(block + 1) * length - 1];
      double sum = 0.0;
      for (std::size_t i = begin; i < end; ++i) {
        sum += weights_[i] * values[static_cast<Eigen::Index>(i)];
      }
      means[static_cast<Eigen::Index>(block)] = sum / static_cast<double>(length);
      begin = end;
    }
    const auto count = static_cast<double>(blocks);
    return std::sqrt((means - means.mean()).square().sum() / (count * (count - 1.0)));
  }

  bool is_autonomous_;
  std::vector<std::size_t> angles_;
  std::vector<std::vector<double>> values_;  // [state][moment]
  std::vector<double> weights_;              // [moment], 1 in each period
  std::vector<std::size_t> ends_;            // [period] moments until its end
};

}  // namespace

std::unique_ptr<ReferenceObservable> make_state_moments(const Model& model) {
  return std::make_unique<StateMoments>(model);
}

}  // namespace gearsweep
