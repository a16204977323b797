// Steps through the surfaces of a model, on the host. A motion has a `state` and `tangents`, of
// Eigen, with a tangent vector in each column.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "model/held_field.hpp"

namespace gearsweep {

// Moments of a step of a phase grid, told by shares of it.
struct StepMoments {
  const Model::PhaseRow* row_at;
  std::size_t width;     // numbers in a row
  double phase, length;  // where the step begins, and its share of the period
  double inside;         // a phase within its segment
  double period;         // in dimensionless time

  std::vector<double> operator()(double share) const;  // a row of phase coefficients
};

// Carries a motion through a part of a step by the classical Runge-Kutta method.
template <class Motion>
void carry_held(HeldField* field, const StepMoments& moment_at, double from, double to,
                Motion* motion) {
  const double h = (to - from) * moment_at.length * moment_at.period;
  const std::vector<double> middle = moment_at(0.5 * (from + to));
  Motion at = *motion, slope = *motion, sum = *motion;
  std::vector<double> jacobian(static_cast<std::size_t>(at.state.size() * at.state.size()));
  // Adds the slope at a moment to the sum, and goes to where the next one is looked for.
  const auto add = [&](const std::vector<double>& coefs, double weight, double reach) {
    field->rhs(coefs.data(), at.state.data(), slope.state.data());
    if (at.tangents.cols() > 0) {
      field->jacobian(coefs.data(), at.state.data(), jacobian.data());
      for (auto j = 0 * at.tangents.cols(); j < at.tangents.cols(); ++j) {
        for (auto i = 0 * at.state.size(); i < at.state.size(); ++i) {
          const double* const row = jacobian.data() + i * at.state.size();
          double change = 0.0;
          for (auto k = 0 * i; k < at.state.size(); ++k) change += row[k] * at.tangents(k, j);
          slope.tangents(i, j) = change;
        }
      }
    }
    sum.state += h * weight * slope.state;
    sum.tangents += h * weight * slope.tangents;
    at.state = motion->state + h * reach * slope.state;
    at.tangents = motion->tangents + h * reach * slope.tangents;
  };
  add(moment_at(from), 1.0 / 6.0, 0.5);
  add(middle, 1.0 / 3.0, 0.5);
  add(middle, 1.0 / 3.0, 1.0);
  add(moment_at(to), 1.0 / 6.0, 0.0);
  *motion = sum;
}

// A step that is cut where the motion comes to a surface or to a limit of a contact, or leaves a
// surface that it slides along. The place is found by halving, with the motion itself.
template <class Motion>
struct HeldStep {
  HeldField* field;
  StepMoments moment_at;
  // Told each part, once it has been taken: from and to where, and the states there.
  std::function<void(double from, double to, const Motion& before, const Motion& after)> each_part;

  void advance(Motion* motion) const {
    constexpr int kMaxCuts = 64;  // of one step; more are rounding
    double from = 0.0;
    for (int part = 0; part < kMaxCuts; ++part) {
      const Motion before = *motion;
      const double to = first_event(from, before);
      take(from, to, motion);
      each_part(from, to, before, *motion);
      const std::vector<double> coefs = moment_at(to);
      const auto surface = field->left_behind(coefs.data(), motion->state.data());
      if (surface) {
        field->pass(*surface, coefs.data(), motion->state.data(),
                    static_cast<std::size_t>(motion->tangents.cols()), motion->tangents.data());
      }
      if (to == 1.0) return;
      from = to;
    }
    const Motion before = *motion;
    take(from, 1.0, motion);
    each_part(from, 1.0, before, *motion);
  }

 private:
  void take(double from, double to, Motion* motion) const {
    carry_held(field, moment_at, from, to, motion);
    field->put_back(moment_at(to).data(), motion->state.data());
  }

  bool is_left_behind(double from, double to, const Motion& start) const {
    Motion probe = start;
    probe.tangents.resize(start.tangents.rows(), 0);
    take(from, to, &probe);
    return field->left_behind(moment_at(to).data(), probe.state.data()).has_value();
  }

  // The share at which the motion is just beyond the first surface; 1 where there is none.
  double first_event(double from, const Motion& start) const {
    constexpr int kLooks = 4;  // so that a surface that is crossed and crossed back is seen
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
};

}  // namespace gearsweep
