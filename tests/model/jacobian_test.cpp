// gear5's Jacobian, which tangent vectors and orbits rest on, against the derivative that dual
// numbers carry through the same right-hand side: in contact, in the gap and wedged.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "support/settings.hpp"
#include "verify/whole_kernel.hpp"

namespace gearsweep::testing {
namespace {

// A number with its derivative.
struct Dual {
  Dual() = default;
  Dual(double v, double d = 0.0) : value(v), slope(d) {}
  double value = 0.0, slope = 0.0;
};
Dual operator-(const Dual& a) { return {-a.value, -a.slope}; }
Dual operator+(const Dual& a, const Dual& b) { return {a.value + b.value, a.slope + b.slope}; }
Dual operator-(const Dual& a, const Dual& b) { return {a.value - b.value, a.slope - b.slope}; }
Dual operator*(const Dual& a, const Dual& b) {
  return {a.value * b.value, a.slope * b.value + a.value * b.slope};
}
Dual operator/(const Dual& a, const Dual& b) {
  const double quotient = a.value / b.value;
  return {quotient, (a.slope - quotient * b.slope) / b.value};
}
bool operator<(const Dual& a, const Dual& b) { return a.value < b.value; }
Dual sqrt(const Dual& a) {
  const double root = std::sqrt(a.value);
  return {root, 0.5 * a.slope / root};
}

namespace dual {
#define REAL_BITS 64
#include "dialect.h"
using real = Dual;
using scalar = double;
#include "gear5.h"
}  // namespace dual

// One right-hand side and its derivative along a state.
class DualField {
 public:
  DualField(const ModelSetting& setting, const std::vector<double>& coefs) {
    std::vector<Dual> values(setting.parameters.begin(), setting.parameters.end());
    dual::ModelParameters parameters;
    static_assert(std::is_trivially_copyable_v<dual::ModelParameters>);
    std::memcpy(static_cast<void*>(&parameters), values.data(), sizeof parameters);
    dual::ModelOptions options;
    std::memcpy(&options, setting.options.data(), sizeof options);
    std::memcpy(&phase_, coefs.data(), sizeof phase_);
    dual::model_prepare(&parameters, options, &point_);
  }

  std::vector<double> derivative(const std::vector<double>& state, std::size_t along) const {
    std::vector<Dual> x(state.begin(), state.end()), dx(state.size());
    x[along].slope = 1.0;
    dual::model_rhs(&point_, &phase_, x.data(), dx.data());
    std::vector<double> slopes;
    for (const Dual& number : dx) slopes.push_back(number.slope);
    return slopes;
  }

 private:
  dual::ModelPoint point_;
  dual::PhaseCoefs phase_;
};

struct Laws {
  std::string formulation, backlash;
};

class Jacobian : public ::testing::TestWithParam<Laws> {};

// Both differentiate the same few operations in another order: a dozen roundings of numbers below
// 10.
TEST_P(Jacobian, IsTheDerivativeOfTheField) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const bool dynamic = GetParam().backlash == "dynamic";
  int touching = 0, gaps = 0, wedged = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    ModelSetting setting = whole_kernel_model().default_setting();
    set_option(&setting, "formulation", GetParam().formulation);
    set_option(&setting, "backlash", GetParam().backlash);
    set_parameter(&setting, "mu", 0.3 * uniform(random));
    set_parameter(&setting, "m2", uniform(random));
    set_parameter(&setting, "b", std::pow(10.0, -2.0 + 2.0 * uniform(random)));
    set_parameter(&setting, "A", std::pow(10.0, 1.0 + 3.0 * uniform(random)));
    const double psi = 0.001 + 0.998 * uniform(random);
    std::vector<double> coefs(whole_kernel_model().phase_coefs.size());
    whole_kernel_model().phase_coefs_at(setting, psi, psi, coefs.data());
    std::vector<double> x(whole_kernel_model().states.size());
    for (double& value : x) value = 2.0 * uniform(random) - 1.0;

    const std::unique_ptr<PreparedPoint> point = whole_kernel_model().prepare(setting);
    std::vector<double> signals(whole_kernel_model().signals.size());
    point->signals(coefs.data(), x.data(), signals.data());
    const double deflection = std::abs(signals[signal_index(whole_kernel_model(), "deflection")]);
    const double backlash = signals[signal_index(whole_kernel_model(), "backlash")];
    ++(deflection < -backlash ? wedged : deflection < backlash ? gaps : touching);

    const DualField field(setting, coefs);
    std::vector<double> jacobian(x.size() * x.size());
    point->jacobian(coefs.data(), x.data(), jacobian.data());
    for (std::size_t j = 0; j < x.size(); ++j) {
      const std::vector<double> column = field.derivative(x, j);
      for (std::size_t i = 0; i < x.size(); ++i) {
        ASSERT_NEAR(jacobian[i * x.size() + j], column[i], 1e-13)
            << "d " << whole_kernel_model().states[i].name << "'/d "
            << whole_kernel_model().states[j].name << ", D " << deflection << ", b' " << backlash;
      }
    }
  }
  EXPECT_GT(touching, 500);
  EXPECT_GT(gaps, 100);
  EXPECT_EQ(wedged > 100, dynamic);
}

INSTANTIATE_TEST_SUITE_P(AllLaws, Jacobian,
                         ::testing::Values(Laws{"consistent", "constant"},
                                           Laws{"consistent", "dynamic"},
                                           Laws{"printed", "constant"}, Laws{"printed", "dynamic"}),
                         [](const auto& laws) {
                           return laws.param.formulation + "_" + laws.param.backlash;
                         });

}  // namespace
}  // namespace gearsweep::testing
