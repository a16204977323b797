#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "model/array.hpp"
#include "model/error.hpp"
#include "orbits/shooting.hpp"
#include "plan/plan.hpp"
#include "study/builtin_models.hpp"
#include "verify/answers.hpp"
#include "verify/detail/check_list.hpp"
#include "verify/detail/exact_answers.hpp"
#include "verify/detail/reference_rows.hpp"

namespace gearsweep {
namespace {

SweepResult compute(const Subject& subject, const std::string& toml) {
  return subject.compute(read_study(toml, "verify"));
}

// Eleven stiffnesses from below to above the square of the forcing's frequency.
std::vector<Compared> compare_oscillator(const Subject& subject, const std::string& integrate,
                                         double tolerance) {
  const LinearOscillator start = {0.1, 1.0, 0.3, 0.8, 1.0, -0.2};
  const SweepResult result = compute(
      subject,
      fmt::format("[model]\nname = 'duffing'\n[parameters]\ncubic = 0.0\ndamping = {}\namplitude = "
                  "{}\nomega = {}\n[[axes]]\nname = 'linear'\nfrom = 0.4\nto = 1.4\ncount = 11\n"
                  "[initial]\npolicy = 'fixed'\nstate = {{x = {}, v = {}}}\n[integrate]\n"
                  "settle = 0\nrecord = 10\nstop = 'never'\n{}[observe]\n"
                  "quantities = ['poincare']\npoincare = ['x', 'v']\n",
                  start.damping, start.amplitude, start.omega, start.x, start.v, integrate));
  std::vector<Compared> compared;
  const std::vector<double>& stiffness = result.study.axes[0].values;
  for (std::size_t point = 0; point < stiffness.size(); ++point) {
    LinearOscillator exact = start;
    exact.stiffness = stiffness[point];
    const std::vector<double> x = samples_of(result, point, 0), v = samples_of(result, point, 1);
    for (std::size_t i = 0; i < x.size(); ++i) {
      const std::size_t period = i + 1;
      const auto at = exact.at(2.0 * std::numbers::pi / exact.omega * static_cast<double>(period));
      const auto name = [&](const char* state) {
        return fmt::format("{} after {} periods, stiffness {:.3g}", state, period,
                           stiffness[point]);
      };
      compared.push_back({name("x"), at.x, x[i], tolerance});
      compared.push_back({name("v"), at.v, v[i], tolerance});
    }
  }
  return compared;
}

// No impact; impacts with dynamic backlash; a larger transmission error; a wedged tooth.
std::vector<const ReferenceRow*> chosen_rows() {
  return {&reference_row("consistent_07"), &reference_row("consistent_05_dynamic"),
          &reference_row("coarse_065"), &reference_row("coarse_05_wedged")};
}

void append(const std::vector<Compared>& more, std::vector<Compared>* compared) {
  compared->insert(compared->end(), more.begin(), more.end());
}

// The answers of this quantity that a model of the zoo has.
std::vector<Compared> compare_answers(const Subject& subject, const std::string& name,
                                      const std::string& quantity) {
  Model model = *find_model(name);
  std::erase_if(model.answers, [&](const auto& answer) { return answer.quantity != quantity; });
  std::vector<Compared> compared;
  for (ComputedAnswer& one : compute_answers(model, fmt::format("name = '{}'", name), subject)) {
    one.number.what += fmt::format(" of {}, {}", name, describe_place(*one.answer));
    compared.push_back(one.number);
  }
  return compared;
}

}  // namespace

// A step h has a phase error of (w h)^5/120: with 2048 to a period, 1e-12 per unit of time at the
// highest frequency, 2e-10 after ten periods.
std::vector<Compared> compare_oscillator_fp64(const Subject& subject) {
  return compare_oscillator(subject, "steps_per_period = 2048\n", 1e-9);
}

// With 256 steps to a period that error is 7e-7; 2560 roundings of 6e-8, if they all added up,
// would be 5e-4 of a state of size 3.
std::vector<Compared> compare_oscillator_fp32(const Subject& subject) {
  return compare_oscillator(subject, "precision = 'fp32'\nsteps_per_period = 256\n", 5e-4);
}

std::vector<Compared> compare_orbits_fp64(const Subject& subject) {
  std::vector<Compared> compared;
  for (const ReferenceRow* row : chosen_rows()) {
    append(compare_row(*row, compute(subject, study_of(*row, converged_steps(*row)))), &compared);
  }
  return compared;
}

std::vector<Compared> compare_orbits_fp32(const Subject& subject) {
  const std::string integrate = "precision = 'fp32'\nsteps_per_period = 512\n";
  std::vector<Compared> compared;
  for (const ReferenceRow* row : chosen_rows()) {
    append(compare_row(*row, compute(subject, study_of(*row, integrate))), &compared);
  }
  return compared;
}

// Chaos and impacts. The Runge-Kutta method and corrected steps leave up to 7e-9 of the trace.
std::vector<Compared> compare_exponent_sum(const Subject& subject) {
  const SweepResult result = compute(
      subject,
      "[model]\npreset = 'coarse'\n[parameters]\nomega = 1.35\n[[axes]]\nname = 'mu'\nvalues = "
      "[0.0, 0.05, 0.2]\n[[axes]]\nname = 'eps'\nvalues = [1.2, 1.5, 1.718, 1.95]\n[integrate]\n"
      "max_step = 0.02\nsettle = 20\nrecord = 40\n[observe]\nquantities = "
      "['lyapunov_spectrum']\n");
  const Plan plan(result.study, result.study.points());
  const std::vector<double>& spectrum = map_of(result, "lyapunov_spectrum");
  const std::size_t width = spectrum.size() / result.status.size();
  std::vector<Compared> compared;
  for (std::size_t point = 0; point < result.status.size(); ++point) {
    double sum = 0.0;
    for (const double exponent : Array2(spectrum, width)[point]) sum += exponent;
    compared.push_back(
        {fmt::format("sum at mu = {:g}, eps = {:g}", plan.study().axis_value(0, point),
                     plan.study().axis_value(1, point)),
         gear5_exponent_sum(plan.setting_of(point)), sum, 2e-8});
  }
  return compared;
}

// Oscillators whose natural frequency is half, a third, five sixths of the forcing's, and so on:
// all go to an orbit of period 1, turning, and the record ends before some of them are there. These
// have no period yet, or 1, and no multiple.
std::vector<Compared> compare_periods(const Subject& subject) {
  const SweepResult result =
      compute(subject,
              "[model]\nname = 'duffing'\n[parameters]\ncubic = 0.0\namplitude = 1.0\n[[axes]]\n"
              "name = 'linear'\nvalues = [0.0625, 0.1111111111, 0.25, 0.4444444444, 0.6944444444, "
              "2.25]\n[[axes]]\nname = 'damping'\nfrom = 0.001\nto = 0.01\ncount = 64\n[initial]\n"
              "policy = 'fixed'\nstate = {x = 0.1, v = 1.0}\n[integrate]\nsteps_per_period = 64\n"
              "settle = 1000\nrecord = 100\nextend = 1\nstop = 'never'\n[observe]\n"
              "quantities = ['period']\n");
  double multiples = 0.0;
  for (const double period : map_of(result, "period")) multiples += period > 1.0 ? 1.0 : 0.0;
  return {{"oscillators with a multiple of their period", 0.0, multiples, 0.0}};
}

std::vector<Compared> compare_published_exponents(const Subject& subject) {
  return compare_answers(subject, "duffing", "lyapunov_spectrum");
}

// The relaxation oscillator with the step that it brings itself.
std::vector<Compared> compare_default_step(const Subject& subject) {
  return compare_answers(subject, "vanderpol", "lyapunov_max");
}

std::vector<Compared> compare_stopped_points(const Subject& subject) {
  std::vector<Compared> compared = compare_answers(subject, "gear5", "dmf_max");
  append(compare_answers(subject, "gear1", "dmf_max"), &compared);
  return compared;
}

// On the stable orbit at 0.65 the device's motion must end. The unstable one at 0.55 lies inside
// chaos; Newton's method starts from four digits of it. Its multipliers are those of an outside
// integration (Dormand-Prince of order 8, impacts located), to eight digits. With 2048 steps to a
// period a wrong derivative at an impact leaves 1e-3 in them, the steps 1e-10.
std::vector<Compared> compare_multipliers(const Subject& subject) {
  const SweepResult result = compute(
      subject,
      "[model]\npreset = 'coarse'\n[[axes]]\nname = 'omega'\nvalues = [0.65]\n[integrate]\n"
      "steps_per_period = 1024\nsettle = 400\nrecord = 1\nstop = 'never'\n[observe]\n"
      "quantities = ['poincare']\npoincare = ['x1', 'x2', 'x3', 'x4', 'x5', 'v1', 'v2', 'v3', "
      "'v4', 'v5']\n");
  const auto orbit_at = [&](double omega, const Eigen::VectorXd& guess) {
    ModelSetting setting = result.study.setting;
    const Model& model = *result.study.model;
    setting.parameters[static_cast<std::size_t>(model.find_parameter("omega"))] = omega;
    const std::optional<Orbit> orbit = shoot(PeriodMap(model, setting, 2048), guess, 1);
    if (!orbit) throw RunError(fmt::format("there is no orbit of period 1 at omega = {}", omega));
    return *orbit;
  };
  std::vector<Compared> compared;
  Eigen::VectorXd settled(10);
  for (Eigen::Index i = 0; i < 10; ++i) {
    settled[i] = samples_of(result, 0, static_cast<std::size_t>(i)).back();
  }
  const Orbit stable = orbit_at(0.65, settled);
  for (Eigen::Index i = 0; i < 10; ++i) {
    compared.push_back({fmt::format("state {} of the orbit at omega = 0.65", i + 1),
                        stable.state[i], settled[i], 1e-8});
  }
  Eigen::VectorXd inside_chaos(10);
  inside_chaos << 0.5419, 0.0002, -0.1870, -0.0002, 0.1870, -0.5034, 0.0026, -0.2401, -0.0026,
      0.2401;
  const std::complex<double> multiplier = orbit_at(0.55, inside_chaos).multipliers[0];
  compared.push_back({"multiplier at omega = 0.55, real", -0.10191766, multiplier.real(), 2e-8});
  compared.push_back(
      {"multiplier at omega = 0.55, imaginary", 1.07545673, std::fabs(multiplier.imag()), 2e-8});
  return compared;
}

}  // namespace gearsweep
