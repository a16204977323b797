// Period doubling at the published parameters: bifurcation points found by shooting, to 8 digits,
// from the description of the models, section "Published answers".
#include <gtest/gtest.h>

#include <cmath>

#include "support/run.hpp"

namespace gearsweep::testing {
namespace {

// How many different values there are among the samples, up to the tolerance.
std::size_t distinct(std::vector<double> samples, double tolerance) {
  std::sort(samples.begin(), samples.end());
  std::size_t count = 1;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    if (samples[i] - samples[i - 1] > tolerance) ++count;
  }
  return count;
}

TEST(Cascade, PendulumDoublesAtThePublishedDamping) {
  std::string values;
  std::vector<double> Q;
  for (int i = 0; i < 80; ++i) {
    Q.push_back(1.337 + 0.0005 * i);
    values += std::to_string(1.0 / Q.back()) + ", ";
  }
  const SweepResult result = run("[model]\nname = 'pendulum'\npreset = 'cascade'\n"
      "[[axes]]\nname = 'damping'\nvalues = [" + values + "]\n[integrate]\nsettle = 2000\n"
      "record = 64\nsteps_per_period = 128\n[observe]\nquantities = ['poincare', 'x_mean']\n"
      "poincare = ['v']\n");
  for (std::size_t i = 0; i < Q.size(); ++i) {
    printf("Q %.4f: %zu %zu  %g\n", Q[i], distinct(samples_of(result, i, 0), 1e-3),distinct(samples_of(result, i, 0), 1e-5), map_of(result, "x_mean")[i]);
  }
}

TEST(Cascade, Duffing) {
  const SweepResult result = run("[model]\nname = 'duffing'\npreset = 'two_well'\n[parameters]\ndamping = 0.3\nomega = 1.2\nphase = 1.5707963267948966\n"
      "[[axes]]\nname = 'amplitude'\nfrom = 0.26\nto = 0.2915\ncount = 64\n[initial]\nstate={x=1.0}\n[integrate]\nsettle = 2000\n"
      "record = 64\nsteps_per_period = 128\n[observe]\nquantities = ['poincare', 'x_mean']\n"
      "poincare = ['v']\n");
  for (std::size_t i = 0; i < 64; ++i) {
    printf("g %.4f: %zu %zu  %g\n", 0.26+0.0005*i, distinct(samples_of(result, i, 0), 1e-3),distinct(samples_of(result, i, 0), 1e-5), map_of(result, "x_mean")[i]);
  }
}

}  // namespace
}  // namespace gearsweep::testing
