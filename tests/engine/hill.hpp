// Hill's method for a linear oscillator whose stiffness swings.
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

#include "support/eigenvalues.hpp"

namespace gearsweep::testing {

// u'' + damping u' + (mean + kappa cos(w t)) u = load by Hill's method: Fourier series of 25
// harmonics, whose coefficients fall faster than factorials.
struct Hill {
  double damping = 0.0, mean = 1.0, kappa = 0.0, omega = 1.0;
  static constexpr int kHarmonics = 12;

  // The coupling of harmonics -12 .. 12 without what the frequency adds.
  Eigen::MatrixXcd stiffness() const {
    const int n = 2 * kHarmonics + 1;
    Eigen::MatrixXcd out = mean * Eigen::MatrixXcd::Identity(n, n);
    for (int i = 0; i + 1 < n; ++i) out(i, i + 1) = out(i + 1, i) = 0.5 * kappa;
    return out;
  }

  // The smallest value of the steady motion.
  double least(double load) const {
    Eigen::MatrixXcd matrix = stiffness();
    for (int n = -kHarmonics; n <= kHarmonics; ++n) {
      const double w = n * omega;
      matrix(n + kHarmonics, n + kHarmonics) += std::complex<double>(-w * w, damping * w);
    }
    Eigen::VectorXcd forces = Eigen::VectorXcd::Zero(matrix.rows());
    forces[kHarmonics] = load;
    const Eigen::VectorXcd part = matrix.partialPivLu().solve(forces);
    double smallest = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 4096; ++i) {
      std::complex<double> value = 0.0;
      for (int n = -kHarmonics; n <= kHarmonics; ++n) {
        value += part[n + kHarmonics] * std::polar(1.0, 2.0 * std::numbers::pi * n * i / 4096.0);
      }
      smallest = std::min(smallest, value.real());
    }
    return smallest;
  }

  // The largest exponent. Those of the middle harmonics are free of the series' end.
  double exponent() const {
    const Eigen::MatrixXcd k = stiffness();
    const Eigen::Index n = k.rows();
    Eigen::MatrixXcd matrix = Eigen::MatrixXcd::Zero(2 * n, 2 * n);
    matrix.topRightCorner(n, n).setIdentity();
    matrix.bottomLeftCorner(n, n) = -k;
    matrix.bottomRightCorner(n, n) = -damping * Eigen::MatrixXcd::Identity(n, n);
    for (Eigen::Index i = 0; i < 2 * n; ++i) {
      matrix(i, i) -= std::complex<double>(0.0, omega * static_cast<double>(i % n - kHarmonics));
    }
    double largest = -std::numeric_limits<double>::infinity();
    // The same map of real and imaginary parts, which has the conjugates of its eigenvalues, too.
    Eigen::MatrixXd parts(4 * n, 4 * n);
    parts << matrix.real(), -matrix.imag(), matrix.imag(), matrix.real();
    for (const std::complex<double>& one : eigenvalues_of(parts)) {
      if (std::abs(one.imag()) < 0.75 * omega) largest = std::max(largest, one.real());
    }
    return largest;
  }
};

}  // namespace gearsweep::testing
