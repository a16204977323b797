// Small oscillators with published answers, written a second time and by hand as models: what these
// tests find does not rest on a model header.
#pragma once

#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "model/model.hpp"

namespace gearsweep::testing {

// x'' = force(parameters, phase coefficient, x, v), and its derivatives by x and v.
struct Oscillator {
  double (*force)(const std::vector<double>& p, double coef, double x, double v);
  double (*by_x)(const std::vector<double>& p, double coef, double x);
  double (*by_v)(const std::vector<double>& p);
  double (*period)(const std::vector<double>& p);
};

class PreparedOscillator final : public PreparedPoint {
 public:
  PreparedOscillator(const Oscillator& oscillator, const ModelSetting& setting)
      : oscillator_(oscillator), p_(setting.parameters) {}
  double period() const override { return oscillator_.period(p_); }
  void rhs(const double* coefs, const double* x, double* dx) const override {
    dx[0] = x[1];
    dx[1] = oscillator_.force(p_, coefs[0], x[0], x[1]);
  }
  void jacobian(const double* coefs, const double* x, double* out) const override {
    out[0] = 0.0;
    out[1] = 1.0;
    out[2] = oscillator_.by_x(p_, coefs[0], x[0]);
    out[3] = oscillator_.by_v(p_);
  }
  void signals(const double*, const double*, double*) const override {}

 private:
  Oscillator oscillator_;
  std::vector<double> p_;
};

// States x and v, one phase coefficient, nothing that jumps.
inline Model bare_model(const std::string& name, const std::vector<std::string>& parameters) {
  Model model{};
  model.name = name;
  model.states = {{"x", "1", "displacement"}, {"v", "1", "velocity"}};
  model.phase_coefs = {{"drive", "1", "what depends on the phase"}};
  for (const std::string& parameter : parameters) {
    model.parameters.push_back({parameter, "1", 0.0, -100.0, 100.0, false, parameter});
  }
  model.check = [](const ModelSetting&) { return std::string(); };
  model.break_phases = [](const ModelSetting&) { return std::vector<double>{0.0}; };
  model.phase_coefs_at = [](const ModelSetting&, double psi, double, double* row) {
    row[0] = std::cos(2.0 * std::numbers::pi * psi);
  };
  model.equilibrium = [](const ModelSetting&) { return std::vector<double>{0.0, 0.0}; };
  return model;
}

// x'' + x'/Q + sin x = 1.5 cos(2 t/3); the parameter is Q.
inline Model pendulum() {
  Model model = bare_model("pendulum", {"Q"});
  model.prepare = [](const ModelSetting& setting) -> std::unique_ptr<PreparedPoint> {
    const Oscillator oscillator = {
        [](const std::vector<double>& p, double drive, double x, double v) {
          return 1.5 * drive - v / p[0] - std::sin(x);
        },
        [](const std::vector<double>&, double, double x) { return -std::cos(x); },
        [](const std::vector<double>& p) { return -1.0 / p[0]; },
        [](const std::vector<double>&) { return 3.0 * std::numbers::pi; }};
    return std::make_unique<PreparedOscillator>(oscillator, setting);
  };
  return model;
}

// x'' + 0.3 x' - x + x^3 = g cos 1.2 t; the parameter is g.
inline Model duffing() {
  Model model = bare_model("duffing", {"g"});
  model.prepare = [](const ModelSetting& setting) -> std::unique_ptr<PreparedPoint> {
    const Oscillator oscillator = {
        [](const std::vector<double>& p, double drive, double x, double v) {
          return p[0] * drive - 0.3 * v + x - x * x * x;
        },
        [](const std::vector<double>&, double, double x) { return 1.0 - 3.0 * x * x; },
        [](const std::vector<double>&) { return -0.3; },
        [](const std::vector<double>&) { return 2.0 * std::numbers::pi / 1.2; }};
    return std::make_unique<PreparedOscillator>(oscillator, setting);
  };
  return model;
}

}  // namespace gearsweep::testing
