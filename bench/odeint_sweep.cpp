// It gets what the kernel has: coefficients from the table, options known to the compiler, the
// right-hand side inlined, a state of fixed size, and -O3 -march=native with contraction.
#include "odeint_sweep.hpp"

#include <algorithm>
#include <array>
#include <boost/numeric/odeint/stepper/runge_kutta4.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta4_classic.hpp>
#include <chrono>
#include <cmath>
#include <cstring>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "dialect.h"

namespace gearsweep::bench {
namespace {

using real = double;
using scalar = double;
#define MODEL_HOST_PART
#include "models/gear5.h"

using State = std::array<double, MODEL_STATE_COUNT>;
using Generic = boost::numeric::odeint::runge_kutta4<State>;
using Classic = boost::numeric::odeint::runge_kutta4_classic<State>;

struct Grid {
  PhaseGrid grid;
  std::vector<PhaseCoefs> rows;
};

struct Point {
  ModelPoint model;
  std::size_t grid;
  State x;
};

// What odeint calls: the four stages of a step in turn.
struct System {
  const ModelPoint& point;
  const PhaseCoefs* rows;
  int stage = 0;
  void operator()(const State& x, State& dx, double) {
    static constexpr std::array<int, 4> kRow = {0, 1, 1, 2};
    model_rhs(&point, rows + kRow[static_cast<std::size_t>(stage++)], x.data(), dx.data());
  }
};

template <class Stepper, bool dynamic>
void advance(const Grid& grid, std::size_t periods, Point* point) {
  ModelPoint model = point->model;
  model.printed = 0;
  model.dynamic = dynamic;
  State x = point->x;
  Stepper stepper;
  for (std::size_t period = 0; period < periods; ++period) {
    const PhaseCoefs* rows = grid.rows.data();
    for (std::size_t segment = 0; segment < grid.grid.segment_steps.size(); ++segment) {
      const double h = grid.grid.segment_fractions[segment] * model.period;
      for (std::uint32_t step = 0; step < grid.grid.segment_steps[segment]; ++step) {
        System system{model, rows};
        stepper.do_step(std::ref(system), x, 0.0, h);
        rows += 2;
      }
      rows += 1;
    }
  }
  point->x = x;
}

Grid make_grid(const PhaseGrid& grid) {
  Grid result{grid,
              std::vector<PhaseCoefs>(grid.coefs.size() * sizeof(double) / sizeof(PhaseCoefs))};
  std::memcpy(result.rows.data(), grid.coefs.data(), grid.coefs.size() * sizeof(double));
  return result;
}

Point make_point(const Plan& plan, std::size_t number, std::size_t grid) {
  const ModelSetting setting = plan.setting_of(number);
  ModelParameters parameters;
  std::memcpy(&parameters, setting.parameters.data(), sizeof parameters);
  ModelOptions options;
  std::memcpy(&options, setting.options.data(), sizeof options);
  Point point{};
  model_prepare(&parameters, options, &point.model);
  point.grid = grid;
  const std::vector<double> start = plan.own_initial_state(number);
  std::copy(start.begin(), start.end(), point.x.begin());
  return point;
}

}  // namespace

struct OdeintSweep::Work {
  std::vector<Grid> grids;
  std::vector<Point> points;
};

OdeintSweep::OdeintSweep(const Plan& plan, const Tile& tile, std::size_t stride,
                         OdeintStepper stepper)
    : work_(std::make_unique<Work>()), stepper_(stepper) {
  std::size_t grid = 0;
  for (const std::size_t start : tile.grid_starts) {
    work_->grids.push_back(make_grid(plan.phase_grid_of(tile.points[start])));
  }
  for (std::size_t position = 0; position < tile.points.size(); position += stride) {
    while (grid + 1 < tile.grid_starts.size() && tile.grid_starts[grid + 1] <= position) ++grid;
    work_->points.push_back(make_point(plan, tile.points[position], grid));
  }
}

OdeintSweep::~OdeintSweep() = default;

template <class Stepper>
void OdeintSweep::advance_every(std::size_t step, std::size_t first, std::size_t periods) {
  for (std::size_t i = first; i < work_->points.size(); i += step) {
    Point& point = work_->points[i];
    const Grid& grid = work_->grids[point.grid];
    if (point.model.dynamic) {
      advance<Stepper, true>(grid, periods, &point);
    } else {
      advance<Stepper, false>(grid, periods, &point);
    }
  }
}

double OdeintSweep::steps_per_second(std::size_t periods) {
  const std::size_t cores = std::max(1U, std::thread::hardware_concurrency());
  const auto run = [&](std::size_t core) {
    if (stepper_ == OdeintStepper::runge_kutta4) {
      advance_every<Generic>(cores, core, periods);
    } else {
      advance_every<Classic>(cores, core, periods);
    }
  };
  double steps = 0.0;
  for (const Point& point : work_->points) {
    steps += static_cast<double>(work_->grids[point.grid].grid.steps * periods);
  }
  const auto start = std::chrono::steady_clock::now();
  {
    std::vector<std::jthread> threads;
    for (std::size_t core = 0; core < cores; ++core) threads.emplace_back(run, core);
  }
  return steps / std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace gearsweep::bench
