#include "reference/detail/lyapunov_observables.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <numeric>

#include "plan/start_tangents.hpp"

namespace gearsweep {
namespace {

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

// What each of the record's periods counts, of mean 1: where there is no clock by a window that
// opens and closes smoothly (kernels/observe.h), otherwise alike.
std::vector<double> weights_of(std::size_t periods, bool is_clockless) {
  std::vector<double> weights(periods, 1.0);
  if (!is_clockless) return weights;
  for (std::size_t i = 0; i < periods; ++i) {
    const double place = (static_cast<double>(i) + 0.5) / static_cast<double>(periods);
    weights[i] = place * place * (1.0 - place) * (1.0 - place);
  }
  const double average = mean(weights);
  for (double& weight : weights) weight /= average;
  return weights;
}

class LyapunovMax final : public ReferenceObservable {
 public:
  explicit LyapunovMax(bool is_clockless) : is_clockless_(is_clockless) {}
  void period(const Eigen::VectorXd&, const Eigen::VectorXd& log_stretching,
              double length) override {
    log_stretchings_.push_back(log_stretching[0]);
    rates_.push_back(log_stretching[0] / length);
  }
  std::vector<double> finish(const Window&) const override {
    const std::vector<double> weights = weights_of(rates_.size(), is_clockless_);
    const double sum = std::inner_product(weights.begin(), weights.end(), rates_.begin(), 0.0);
    return {sum / static_cast<double>(rates_.size()), error(), mean(log_stretchings_)};
  }

 private:
  // Not a number where there is one period alone.
  double error() const {
    const double of_blocks = standard_error();
    return std::isnan(of_blocks) ? of_blocks : std::max(of_blocks, straying());
  }

  // How far the second half's sum strays from a line that goes on as the first half did.
  double straying() const {
    const auto middle = rates_.begin() + static_cast<std::ptrdiff_t>(rates_.size() / 2);
    const double slope = mean({rates_.begin(), middle});
    std::vector<double> strayed = {0.0};
    std::transform(middle, rates_.end(), std::back_inserter(strayed),
                   [&](double rate) { return strayed.back() + (rate - slope); });
    const auto [min, max] = std::ranges::minmax(strayed);
    constexpr double kCaution = 1.25;  // kernels/observables/lyapunov_max.h
    return kCaution * (max - min) / static_cast<double>(rates_.size());
  }

  // The standard error of the mean of 16 (or a few more) blocks that do not overlap; what is left
  // of the periods takes no part.
  double standard_error() const {
    constexpr std::size_t kBlocks = 16;
    const std::size_t length = std::max<std::size_t>(1, rates_.size() / kBlocks);
    std::vector<double> means;
    for (auto first = rates_.begin(); rates_.end() - first >= static_cast<std::ptrdiff_t>(length);
         first += static_cast<std::ptrdiff_t>(length)) {
      means.push_back(mean({first, first + static_cast<std::ptrdiff_t>(length)}));
    }
    if (means.size() < 2) return std::numeric_limits<double>::quiet_NaN();
    const double middle = mean(means);
    double squares = 0.0;
    for (const double value : means) squares += (value - middle) * (value - middle);
    const auto count = static_cast<double>(means.size());
    const double of_window = is_clockless_ ? 10.0 / 7.0 : 1.0;  // the mean square of the weights
    return std::sqrt(of_window * squares / (count * (count - 1.0)));
  }

  bool is_clockless_;
  std::vector<double> log_stretchings_, rates_;
};

class LyapunovSpectrum final : public ReferenceObservable {
 public:
  explicit LyapunovSpectrum(bool is_clockless) : is_clockless_(is_clockless) {}
  void period(const Eigen::VectorXd&, const Eigen::VectorXd& log_stretching,
              double length) override {
    rates_.push_back(log_stretching / length);
  }
  std::vector<double> finish(const Window&) const override {
    const std::vector<double> weights = weights_of(rates_.size(), is_clockless_);
    Eigen::VectorXd means = Eigen::VectorXd::Zero(rates_.front().size());
    for (std::size_t i = 0; i < rates_.size(); ++i) means += weights[i] * rates_[i];
    means /= static_cast<double>(rates_.size());
    std::vector<double> exponents(means.begin(), means.end());
    std::sort(exponents.begin(), exponents.end(), std::greater<>());
    return exponents;
  }

 private:
  bool is_clockless_;
  std::vector<Eigen::VectorXd> rates_;  // [period]
};

class KaplanYorke final : public ReferenceObservable {
 public:
  // clocks: of the model, each with an exponent 0 that the spectrum does not show.
  KaplanYorke(std::size_t clocks, bool is_clockless)
      : clocks_(static_cast<double>(clocks)), spectrum_(is_clockless) {}
  void period(const Eigen::VectorXd& state, const Eigen::VectorXd& log_stretching,
              double length) override {
    spectrum_.period(state, log_stretching, length);
  }
  std::vector<double> finish(const Window& window) const override {
    const std::vector<double> exponents = spectrum_.finish(window);
    double sum = 0.0;
    for (std::size_t j = 0; j < exponents.size(); ++j) {
      if (sum + exponents[j] < 0.0) {
        return {clocks_ + static_cast<double>(j) + sum / -exponents[j]};
      }
      sum += exponents[j];
    }
    return {clocks_ + static_cast<double>(exponents.size())};
  }

 private:
  double clocks_;
  LyapunovSpectrum spectrum_;
};

}  // namespace

void set_start_tangents(std::size_t count, const Model& model, Trajectory* trajectory) {
  const Eigen::Index states = trajectory->state().size();
  const std::vector<double> vectors = start_tangents(count, model);
  if (count == 0) return;
  trajectory->set_tangents(
      Eigen::Map<const Eigen::MatrixXd>(vectors.data(), states, static_cast<Eigen::Index>(count)));
}

Eigen::VectorXd orthonormalize_tangents(Trajectory* trajectory) {
  const Eigen::MatrixXd& grown = trajectory->tangents();
  const Eigen::Index count = grown.cols();
  if (count == 0) return {};
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(grown);
  Eigen::VectorXd stretching = qr.matrixQR().diagonal().cwiseAbs();
  if (trajectory->take_slid()) {
    // What a vector has across a surface that the motion begins to slide along is lost, and what a
    // reset writes over.
    constexpr double kLost = 1e-12;
    for (Eigen::Index j = 0; j < count; ++j) {
      if (stretching[j] < kLost * grown.col(j).norm()) stretching[j] = 0.0;
    }
  }
  const Eigen::VectorXd log_stretching = stretching.array().log();
  trajectory->set_tangents(qr.householderQ() * Eigen::MatrixXd::Identity(grown.rows(), count));
  return log_stretching;
}

std::unique_ptr<ReferenceObservable> make_lyapunov_max(bool is_clockless) {
  return std::make_unique<LyapunovMax>(is_clockless);
}
std::unique_ptr<ReferenceObservable> make_lyapunov_spectrum(bool is_clockless) {
  return std::make_unique<LyapunovSpectrum>(is_clockless);
}
std::unique_ptr<ReferenceObservable> make_kaplan_yorke(const Model& model) {
  return std::make_unique<KaplanYorke>(model.clocks, model.is_clockless);
}

}  // namespace gearsweep
