// gear1 without stiffness variation is linear between its impacts: its orbits and their multipliers
// in closed form but for the instants of the impacts, which a bisection finds to rounding.
#pragma once

#include <Eigen/LU>
#include <cmath>
#include <complex>
#include <numbers>

#include "orbits/example_orbits.hpp"

namespace gearsweep::testing {

// x'' + 2 z x' + f(x; 1) = Fm + Fte w^2 cos(w t).
struct ImpactOscillator {
  double z = 0.05, Fm = 0.1, Fte = 0.1, w = 0.8;

  double period() const { return 2.0 * std::numbers::pi / w; }

  Example example() const {
    return Example("gear1", {{"omega", w},
                             {"z", z},
                             {"Fm", Fm},
                             {"Fte", Fte},
                             {"Fte_2", 0.0},
                             {"Fte_3", 0.0},
                             {"k", 0.0},
                             {"k_2", 0.0},
                             {"k_3", 0.0}});
  }

  // The state at phase 0 of the linear motion on the drive flank, and how far it swings.
  std::complex<double> swing() const {
    return Fte * w * w / std::complex<double>(1.0 - w * w, 2.0 * z * w);
  }
  Eigen::Vector2d linear_state() const { return {1.0 + Fm + swing().real(), -w * swing().imag()}; }

  struct Image {
    Eigen::Vector2d state;
    Eigen::Matrix2d monodromy;
    int impacts;  // crossings of a limit
  };
  // One period from phase 0.
  Image advance(const Eigen::Vector2d& start) const {
    // So many pieces that none holds two turns, nor a turn and a crossing of another limit.
    const int pieces = 400;
    Image at{start, Eigen::Matrix2d::Identity(), 0};
    double t = 0.0;
    int side = side_of(start);
    for (int i = 1; i <= pieces; ++i) {
      const double end = period() * i / pieces;
      while (t < end) {
        double to = end;
        // A piece with a turn ends there, so that a short visit beyond a limit is seen.
        if ((at.state[1] > 0.0) != (move(side, at.state, t, to)[1] > 0.0)) {
          to = instant(t, to, [&](double s) {
            return (move(side, at.state, t, s)[1] > 0.0) != (at.state[1] > 0.0);
          });
        }
        const auto left = [&](double s) { return side_of(move(side, at.state, t, s)) != side; };
        const bool crosses = left(to);
        if (crosses) to = instant(t, to, left);
        at.monodromy = derivative(side, to - t) * at.monodromy;
        at.state = move(side, at.state, t, to);
        if (crosses) {
          side = side_of(at.state);
          ++at.impacts;
        }
        t = to;
      }
    }
    return at;
  }

  // The orbit of period 1 that Newton's method finds from `guess`.
  Image orbit(const Eigen::Vector2d& guess) const {
    Eigen::Vector2d state = guess;
    for (int i = 0; i < 30; ++i) {
      const Image image = advance(state);
      state += (Eigen::Matrix2d::Identity() - image.monodromy).inverse() * (image.state - state);
    }
    Image image = advance(state);
    image.state = state;
    return image;
  }

 private:
  static int side_of(const Eigen::Vector2d& at) { return at[0] > 1.0 ? 1 : at[0] < -1.0 ? -1 : 0; }

  // The smallest time between two at which `passed` holds, which it does at the later one.
  template <class Passed>
  static double instant(double from, double to, const Passed& passed) {
    while (true) {
      const double middle = 0.5 * (from + to);
      if (middle <= from || middle >= to) return to;
      (passed(middle) ? to : from) = middle;
    }
  }

  // The free motion's matrix over a time.
  Eigen::Matrix2d derivative(int side, double time) const {
    Eigen::Matrix2d out;
    if (side == 0) {
      const double decay = std::exp(-2.0 * z * time);
      out << 1.0, (1.0 - decay) / (2.0 * z), 0.0, decay;
      return out;
    }
    const double f = std::sqrt(1.0 - z * z);
    const double c = std::cos(f * time), s = std::sin(f * time) / f;
    out << c + z * s, s, -s, c - z * s;
    return std::exp(-z * time) * out;
  }

  // A forced motion: any solution of one side's equation.
  Eigen::Vector2d forced(int side, double t) const {
    const std::complex<double> turn = std::polar(1.0, w * t), i(0.0, 1.0);
    if (side != 0) {
      return {side + Fm + (swing() * turn).real(), (i * w * swing() * turn).real()};
    }
    const std::complex<double> speed = Fte * w * w / (i * w + 2.0 * z);
    return {Fm / (2.0 * z) * t + (speed / (i * w) * turn).real(),
            Fm / (2.0 * z) + (speed * turn).real()};
  }

  Eigen::Vector2d move(int side, const Eigen::Vector2d& at, double from, double to) const {
    return forced(side, to) + derivative(side, to - from) * (at - forced(side, from));
  }
};

}  // namespace gearsweep::testing
