// What answers of the zoo that take code are made of.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <complex>
#include <initializer_list>
#include <string>

#include "engine/exact_pieces.hpp"
#include "orbits/example_orbits.hpp"
#include "support/eigenvalues.hpp"
#include "support/run.hpp"
#include "support/text.hpp"

namespace gearsweep::testing {

// A study of a few points by the device. Without exponents its program takes half the time to
// build.
struct Points {
  std::string model, parameters, axis, start, quantities;
  std::size_t settle = 400, record = 32, steps = 512;

  SweepResult run() const {
    std::string states;
    for (const ChannelInfo& state : find_model(model)->states) states += "'" + state.name + "', ";
    return testing::run(fmt::format(
        "[model]\nname = '{}'\n[parameters]\n{}\n[[axes]]\n{}\n[initial]\n{}\n[integrate]\n"
        "settle = {}\nrecord = {}\nsteps_per_period = {}\nextend = 1\nstop = 'never'\n"
        "[observe]\npoincare = [{}]\nquantities = ['poincare', {}]\n",
        model, parameters, axis, start.empty() ? "policy = 'shifted'" : start, settle, record,
        steps, states, quantities));
  }
};

inline std::string at_omega(double omega) {
  return "name = 'omega'\nvalues = [" + digits(omega) + "]";
}

// The orbit that `example` settles on is the exact one, and has its multipliers.
inline void expect_orbit(const Example& example, const ExactPieces& exact, std::size_t crossings,
                         double tolerance) {
  const Orbit found = shoot(example.map(), example.orbit(150, 256).state, 1).value();
  const ExactPieces::Image orbit = exact.orbit(found.state);
  EXPECT_EQ(orbit.crossings, crossings);
  EXPECT_LT((found.state - orbit.state).cwiseAbs().maxCoeff(), tolerance);
  for (const std::complex<double>& one : eigenvalues_of(orbit.monodromy)) {
    EXPECT_LT((found.multipliers.array() - one).abs().minCoeff(), tolerance) << one;
  }
}

inline Eigen::VectorXd vector_of(std::initializer_list<double> values) {
  Eigen::VectorXd out(static_cast<Eigen::Index>(values.size()));
  std::copy(values.begin(), values.end(), out.data());
  return out;
}

}  // namespace gearsweep::testing
