#include "engine/outside_gear5.hpp"

#include <algorithm>
#include <boost/numeric/odeint.hpp>
#include <cmath>
#include <numbers>

#include "support/settings.hpp"

namespace gearsweep::testing {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

}  // namespace

OutsideGear::OutsideGear(const ModelSetting& setting) {
  const auto value = [&](const char* name) { return parameter_of(setting, name); };
  omega_ = value("omega");
  b_ = value("b");
  mu_ = value("mu");
  F1_ = value("F1");
  e0_ = value("e0");
  zeta_ = value("zeta");
  m1_ = value("m1");
  m2_ = value("m2");
  k_ = {value("k1"), value("k2"), value("k3"), value("k4")};
  c_ = {value("c1"), value("c2"), value("c3"), value("c4")};
  eps_ = value("eps");
  engagement_ = value("engagement");
  pitch_point_ = value("approach") * eps_;
  alpha_ = value("alpha") * std::numbers::pi / 180.0;
  A_ = value("A");
  rho_p_ = value("rho_p");
  rho_g_ = value("rho_g");
  zp_ = value("zp");
  ratio_ = value("teeth_ratio");
  q_ = value("q");
  kappa_ = value("kappa");
  phase_ = value("phase");
  formulation_ = option_of(setting, "formulation");
  stiffness_ = option_of(setting, "stiffness");
  dynamic_ = option_of(setting, "backlash") == "dynamic";
  cycle_ = value("cycle");
  lines_.push_back({e0_, 1.0, value("e0_phase")});
  if (option_of(setting, "error") == "series") {
    for (int i = 2; i <= 8; ++i) {
      const std::string number = std::to_string(i);
      lines_.push_back({value(("e0_" + number).c_str()), static_cast<double>(i),
                        value(("e0_phase_" + number).c_str())});
    }
    lines_.push_back({value("runout_p"), 1.0 / zp_, value("runout_phase_p")});
    lines_.push_back({value("runout_g"), 1.0 / (zp_ * ratio_), value("runout_phase_g")});
  }
  damage_p_ = value("damage_p");
  damage_g_ = value("damage_g");
  breaks_ = {1.0};
  for (double begin = 0.0; begin < cycle_; ++begin) {
    for (const double phase : {0.0, eps_ - 1.0, std::fmod(pitch_point_, 1.0), engagement_,
                               std::fmod(eps_ - engagement_, 1.0)}) {
      breaks_.push_back((begin + phase) / cycle_);
    }
  }
  std::sort(breaks_.begin(), breaks_.end());
  // The mean of all pairs is that over one pair's positions, by Gauss's three points, which are
  // exact for these polynomials.
  gripped_ = 0.0;
  const std::array<double, 4> bounds = {0.0, engagement_, eps_ - engagement_, eps_};
  for (std::size_t i = 0; i < 3; ++i) {
    const double half = 0.5 * (bounds[i + 1] - bounds[i]), middle = bounds[i] + half;
    const double aside = half * std::sqrt(0.6);
    gripped_ += half / 9.0 *
                (5.0 * shape(middle - aside) + 8.0 * shape(middle) + 5.0 * shape(middle + aside));
  }
}

double OutsideGear::period() const { return cycle_ * kTurn / omega_; }

void OutsideGear::damage_pinion(std::function<double(double)> lost,
                                const std::vector<double>& bends) {
  lost_ = std::move(lost);
  for (double turn = 0.0; turn < cycle_; turn += zp_) {
    for (const double bend : bends) breaks_.push_back((turn + bend * eps_) / cycle_);
  }
  std::sort(breaks_.begin(), breaks_.end());
}

double OutsideGear::left_by_damage(long entered, double place) const {
  const auto tooth = [&](double teeth) {
    const long count = std::lround(teeth);
    return (entered % count + count) % count;
  };
  double left = 1.0;
  if (tooth(zp_) == 0) left -= (lost_ ? lost_(place) : damage_p_) * left;
  if (tooth(zp_ * ratio_) == 0) left -= damage_g_ * left;
  return left;
}

OutsideGear::Error OutsideGear::error(double psi) const {
  Error sum;
  for (const Line& line : lines_) {
    const double angle = line.order * kTurn * cycle_ * psi + line.phase;
    sum.value += line.amplitude * std::sin(angle);
    sum.second -= std::pow(line.order, 2) * line.amplitude * std::sin(angle);
  }
  return sum;
}

double OutsideGear::pair_stiffness(std::size_t pair, double psi, bool in_contact) const {
  if (stiffness_ == "fourier") return (1.0 + kappa_ * std::cos(kTurn * psi + phase_)) / 2.0;
  if (!in_contact) return 0.0;
  return shape(psi + static_cast<double>(pair)) / gripped_;
}

double OutsideGear::shape(double position) const {
  const double middle = eps_ / 2.0;
  const double fall = stiffness_ == "rectangular" ? 0.0 : q_;
  const double from_end = std::max(std::min(position, eps_ - position), 0.0);
  double grip = 1.0;
  if (from_end < engagement_) {
    const double u = from_end / engagement_;
    grip = u * u * (3.0 - 2.0 * u);
  }
  return grip * (1.0 - fall * std::pow((position - middle) / middle, 2));
}

MeshSums OutsideGear::sums(double phase, double phase_inside) const {
  const double begun = std::floor(cycle_ * phase_inside);  // mesh periods
  const double psi = cycle_ * phase - begun, inside = cycle_ * phase_inside - begun;
  const double tan_alpha = std::tan(alpha_);
  const double base_pitch = kTurn / zp_;    // pb/Rp
  std::array<double, 2> kappa{}, g{}, h{};  // of pair 1 and 2: stiffness, mesh and sliding factors
  for (std::size_t i = 0; i < 2; ++i) {
    const double position = psi + static_cast<double>(i);
    const double side = inside + static_cast<double>(i);
    const bool in_contact = side < eps_;
    double lambda = 0.0;
    if (in_contact) lambda = side < pitch_point_ ? 1.0 : -1.0;
    // s_p/Rp is tan(alpha) at the pitch point and grows by pb per base pitch; the line of action
    // has the length (Rp + Rg) tan(alpha) = s_p + s_g.
    const double arm_p = tan_alpha + (position - pitch_point_) * base_pitch;
    const double arm_g = ((1.0 + ratio_) * tan_alpha - arm_p) / ratio_;
    kappa[i] = pair_stiffness(i, psi, in_contact) *
               left_by_damage(std::lround(begun) - static_cast<long>(i), position / eps_);
    if (formulation_ == "printed") {
      const double sigma = -lambda;
      g[i] = 1.0 + mu_ * sigma * arm_g;
      h[i] = mu_ * sigma;
    } else {
      g[i] = 1.0 - mu_ * lambda * (rho_p_ * arm_p + rho_g_ * arm_g);
      h[i] = mu_ * lambda;
    }
  }
  return {kappa[0] + kappa[1], g[0] + g[1], h[0] + h[1], g[0] * kappa[0] + g[1] * kappa[1],
          h[0] * kappa[0] + h[1] * kappa[1]};
}

double OutsideGear::deflection(const OutsideState& x) const {
  const double sign = formulation_ == "printed" ? 1.0 : -1.0;
  return x[0] + sign * (x[2] - x[4]);
}

double OutsideGear::backlash(const OutsideState& x) const {
  if (!dynamic_) return b_;
  const double u = x[3] - x[1];
  const double v = x[2] - x[4];
  const double n = 2.0 * A_ * (u * std::cos(alpha_) + v * std::sin(alpha_)) + u * u + v * v;
  const double S = std::hypot(A_ * std::cos(alpha_) + u, -v - A_ * std::sin(alpha_));
  return b_ + n / (S + A_) * std::tan(alpha_);
}

void OutsideGear::watch(const OutsideState& before, const OutsideState& after, double h,
                        OutsideRange* range) const {
  constexpr int kParts = 64;
  const auto at = [&](int part) {
    const double t = static_cast<double>(part) / kParts;
    const double r = 1.0 - t;
    OutsideState x{};
    for (std::size_t i = 0; i < 5; ++i) {
      x[i] = r * r * (1.0 + 2.0 * t) * before[i] + t * t * (3.0 - 2.0 * t) * after[i] +
             h * t * r * (r * before[i + 5] - t * after[i + 5]);
    }
    return x;
  };
  const auto share_above_zero = [](double a, double b) {
    if ((a > 0.0) == (b > 0.0)) return a > 0.0 ? 1.0 : 0.0;
    return std::max(a, b) / (std::abs(a) + std::abs(b));
  };
  OutsideState last = at(0);
  for (int i = 1; i <= kParts; ++i) {
    const OutsideState x = at(i);
    range->min = std::min({range->min, last[0], x[0]});
    range->max = std::max({range->max, last[0], x[0]});
    const double share = h / kParts / period();
    range->drive +=
        share * share_above_zero(deflection(last) - backlash(last), deflection(x) - backlash(x));
    range->back +=
        share * share_above_zero(-deflection(last) - backlash(last), -deflection(x) - backlash(x));
    last = x;
  }
}

void OutsideGear::slope(double psi, double inside, const OutsideState& x, OutsideState* dx) const {
  const MeshSums s = sums(psi, inside);
  const double sign = formulation_ == "printed" ? 1.0 : -1.0;
  const double D = deflection(x);
  const double Dp = x[5] + sign * (x[7] - x[9]);
  const double limit = backlash(x);
  double f = 0.0;
  if (D > limit) f += D - limit;
  if (D < -limit) f += D + limit;  // both when the backlash is negative: a wedged tooth

  const double two_zeta = 2.0 * zeta_;
  for (std::size_t i = 0; i < 5; ++i) (*dx)[i] = x[i + 5];
  (*dx)[5] = F1_ - omega_ * omega_ * error(psi).second - s.Q * f - two_zeta * s.G * Dp;
  (*dx)[6] =
      -two_zeta * m1_ * c_[0] * x[6] - m1_ * k_[0] * x[1] - m1_ * (s.C * f + two_zeta * s.H * Dp);
  (*dx)[7] =
      -two_zeta * m1_ * c_[1] * x[7] - m1_ * k_[1] * x[2] + m1_ * (s.B * f + 2.0 * two_zeta * Dp);
  (*dx)[8] =
      -two_zeta * m2_ * c_[2] * x[8] - m2_ * k_[2] * x[3] + m2_ * (s.C * f + two_zeta * s.H * Dp);
  (*dx)[9] =
      -two_zeta * m2_ * c_[3] * x[9] - m2_ * k_[3] * x[4] - m2_ * (s.B * f + 2.0 * two_zeta * Dp);
  (*dx)[10] = x[0] / period();
  (*dx)[11] = x[0] * x[0] / period();
}

void OutsideGear::advance_period(double tolerance, OutsideState* x, OutsideRange* range) const {
  namespace odeint = boost::numeric::odeint;
  for (std::size_t i = 0; i + 1 < breaks_.size(); ++i) {
    const double from = breaks_[i];
    const double to = breaks_[i + 1];
    if (!(to > from)) continue;
    const double inside = 0.5 * (from + to);
    const auto by_phase = [&](const OutsideState& at, OutsideState& dx, double psi) {
      slope(psi, inside, at, &dx);
      for (double& d : dx) d *= period();
    };
    auto stepper =
        odeint::make_controlled(tolerance, tolerance, odeint::runge_kutta_dopri5<OutsideState>());
    OutsideState before = *x;
    double psi_before = from;
    const auto each_step = [&](const OutsideState& at, double psi) {
      if (range != nullptr) watch(before, at, (psi - psi_before) * period(), range);
      before = at;
      psi_before = psi;
    };
    odeint::integrate_adaptive(stepper, by_phase, *x, from, to, 1e-3 * (to - from), each_step);
  }
}

OutsideState outside_state(const std::vector<double>& model_state) {
  OutsideState x{};
  std::copy(model_state.begin(), model_state.end(), x.begin());
  return x;
}

}  // namespace gearsweep::testing
