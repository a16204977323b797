// A trajectory restarts at each break phase, where the equations jump, with the step that it had.
// Between two of them all that depends on the phase but the sine of the forcing is a polynomial of
// at most third degree, and is evaluated as one.
#include "dopri_sweep.hpp"

#include <algorithm>
#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/generation.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>
#include <chrono>
#include <cmath>
#include <cstring>
#include <thread>

#include "dialect.h"
#include "header_points.hpp"

namespace gearsweep::bench {
namespace {

using real = double;
using scalar = double;
#include "equations/headers/gear5.h"

namespace odeint = boost::numeric::odeint;

static_assert(std::tuple_size_v<GearState> == MODEL_STATE_COUNT);
constexpr std::size_t kCoefs = sizeof(PhaseCoefs) / sizeof(double);
constexpr double kTurn = 6.283185307179586476925;

using CoefRow = std::array<double, kCoefs>;

// The part of the period between two break phases.
struct Segment {
  double from, to;
  std::array<CoefRow, 4> powers;  // of the coefficients' polynomials in (phase - from)

  PhaseCoefs at(double psi) const {
    const double s = psi - from;
    CoefRow row;
    for (std::size_t i = 0; i < kCoefs; ++i) {
      row[i] = powers[0][i] + s * (powers[1][i] + s * (powers[2][i] + s * powers[3][i]));
    }
    PhaseCoefs coefs;
    std::memcpy(&coefs, row.data(), sizeof coefs);
    coefs.sine = std::sin(kTurn * psi);
    return coefs;
  }
};

// The cubics through four equidistant phases, by Newton's divided differences.
Segment make_segment(const Model& model, const ModelSetting& setting, double from, double to) {
  const double step = (to - from) / 3.0;
  std::array<CoefRow, 4> rows;
  for (std::size_t i = 0; i < 4; ++i) {
    model.phase_coefs_at(setting, from + step * static_cast<double>(i), 0.5 * (from + to),
                         rows[i].data());
  }
  Segment segment{from, to, {}};
  for (std::size_t i = 0; i < kCoefs; ++i) {
    const double d1 = (rows[1][i] - rows[0][i]) / step;
    const double d2 = (rows[2][i] - 2.0 * rows[1][i] + rows[0][i]) / (2.0 * step * step);
    const double d3 = (rows[3][i] - 3.0 * rows[2][i] + 3.0 * rows[1][i] - rows[0][i]) /
                      (6.0 * step * step * step);
    segment.powers[0][i] = rows[0][i];
    segment.powers[1][i] = d1 - step * d2 + 2.0 * step * step * d3;
    segment.powers[2][i] = d2 - 3.0 * step * d3;
    segment.powers[3][i] = d3;
  }
  return segment;
}

// Advances x through a segment; `step` is the length of phase to try first, and then to try next.
template <bool dynamic>
void advance(const Segment& segment, const ModelPoint& point, double tolerance, double* step,
             GearState* x) {
  ModelPoint model = point;
  model.printed = 0;
  model.dynamic = dynamic;
  const auto slope = [&](const GearState& at, GearState& dx, double psi) {
    const PhaseCoefs coefs = segment.at(psi);
    model_rhs(&model, &coefs, at.data(), dx.data());
    for (double& d : dx) d *= model.period;
  };
  auto stepper =
      odeint::make_controlled(tolerance, tolerance, odeint::runge_kutta_dopri5<GearState>());
  double psi = segment.from;
  while (psi < segment.to) {
    const bool reaches_end = psi + *step >= segment.to;
    double tried = reaches_end ? segment.to - psi : *step;
    const bool is_done = stepper.try_step(slope, *x, psi, tried) == odeint::success;
    if (is_done && reaches_end) {
      *step = std::max(*step, tried);
      return;
    }
    *step = tried;
  }
}

}  // namespace

struct DopriSweep::Point {
  ModelPoint model;
  GearState start;
  std::vector<Segment> segments;
};

DopriSweep::DopriSweep(const Plan& plan, const std::vector<std::size_t>& points) {
  for (const std::size_t number : points) {
    const ModelSetting setting = header_setting(plan, number);
    ModelParameters parameters;
    std::memcpy(&parameters, setting.parameters.data(), sizeof parameters);
    ModelOptions options;
    std::memcpy(&options, setting.options.data(), sizeof options);
    Point point{};
    model_prepare(&parameters, options, &point.model);
    const std::vector<double> start = plan.own_initial_state(number);
    std::copy(start.begin(), start.end(), point.start.begin());
    const std::vector<double> bounds = segment_bounds(gear5_header(), setting);
    for (std::size_t i = 0; i + 1 < bounds.size(); ++i) {
      point.segments.push_back(make_segment(gear5_header(), setting, bounds[i], bounds[i + 1]));
    }
    points_.push_back(std::move(point));
  }
}

DopriSweep::~DopriSweep() = default;

DopriSweep::Run DopriSweep::run(double tolerance, std::size_t periods) const {
  const std::size_t cores = std::max(1U, std::thread::hardware_concurrency());
  Run result;
  result.states.resize(points_.size());
  const auto work = [&](std::size_t first) {
    for (std::size_t i = first; i < points_.size(); i += cores) {
      const Point& point = points_[i];
      GearState x = point.start;
      double step = 1e-3;
      for (std::size_t period = 0; period < periods; ++period) {
        for (const Segment& segment : point.segments) {
          if (point.model.dynamic) {
            advance<true>(segment, point.model, tolerance, &step, &x);
          } else {
            advance<false>(segment, point.model, tolerance, &step, &x);
          }
        }
      }
      result.states[i] = x;
    }
  };
  const auto start = std::chrono::steady_clock::now();
  {
    std::vector<std::jthread> threads;
    for (std::size_t core = 0; core < cores; ++core) threads.emplace_back(work, core);
  }
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace gearsweep::bench
