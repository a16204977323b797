// Points of gear5 that Boost.odeint advances. Included into a namespace that has `real` (one number
// for each of kLanes points), `scalar` and `fill_lanes`; so no include guard and no includes of the
// standard library.
#include "equations/headers/gear5.h"

using State = std::array<real, MODEL_STATE_COUNT>;
using Generic = boost::numeric::odeint::runge_kutta4<State, scalar, State, real>;
using Classic = boost::numeric::odeint::runge_kutta4_classic<State, scalar, State, real>;

// Steps of a phase grid with their coefficients in this precision.
struct Grid {
  PhaseGrid grid;
  std::vector<PhaseCoefs> rows;
};

// kLanes neighbouring points.
struct Pack {
  ModelPoint model;
  std::size_t grid = 0;
  State x;
};

// What odeint calls: the four stages of a step in turn.
struct System {
  const ModelPoint& point;
  const PhaseCoefs* rows;
  std::size_t stage = 0;
  void operator()(const State& x, State& dx, const real&) {
    static constexpr std::array<std::size_t, 4> kRow = {0, 1, 1, 2};
    model_rhs(&point, rows + kRow[stage++], x.data(), dx.data());
  }
};

template <class Stepper, bool dynamic>
void advance(const Grid& grid, std::size_t periods, Pack* pack) {
  ModelPoint model = pack->model;
  model.printed = 0;
  model.dynamic = dynamic;
  State x = pack->x;
  Stepper stepper;
  for (std::size_t period = 0; period < periods; ++period) {
    const PhaseCoefs* rows = grid.rows.data();
    for (std::size_t segment = 0; segment < grid.grid.segment_steps.size(); ++segment) {
      const real h = static_cast<scalar>(grid.grid.segment_fractions[segment]) * model.period;
      for (std::uint32_t step = 0; step < grid.grid.segment_steps[segment]; ++step) {
        System system{model, rows};
        stepper.do_step(std::ref(system), x, real(0), h);
        rows += 2;
      }
      rows += 1;
    }
  }
  pack->x = x;
}

// The grid of a point, with the steps that it has in the plan.
inline Grid make_grid(const Plan& plan, std::size_t point) {
  Grid result{plan.phase_grid_of(point), {}};
  const std::vector<double> coefs = header_coefs(result.grid, header_setting(plan, point));
  const double* coef = coefs.data();
  result.rows.resize(coefs.size() * sizeof(scalar) / sizeof(PhaseCoefs));
#define SET_COEF(name, meaning) row.name = static_cast<scalar>(*coef++);
  for (PhaseCoefs& row : result.rows) {
    MODEL_PHASE_COEFS(SET_COEF)
  }
#undef SET_COEF
  return result;
}

// kLanes points from the first on.
inline Pack make_pack(const Plan& plan, const PointList& points, std::size_t first,
                      std::size_t grid) {
  std::vector<ModelSetting> settings;
  std::vector<std::vector<double>> starts;
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    settings.push_back(header_setting(plan, points[first + lane]));
    starts.push_back(plan.own_initial_state(points[first + lane]));
  }
  ModelParameters parameters;
  std::size_t index = 0;
#define SET_PARAMETER(name, unit, value, min, max, shapes_phase, meaning)             \
  parameters.name =                                                                   \
      fill_lanes([&](std::size_t lane) { return settings[lane].parameters[index]; }), \
  ++index;
  MODEL_PARAMETERS(SET_PARAMETER)
#undef SET_PARAMETER
  ModelOptions options;
  std::memcpy(&options, settings.front().options.data(), sizeof options);
  Pack pack;
  model_prepare(&parameters, options, &pack.model);
  pack.grid = grid;
  for (std::size_t i = 0; i < pack.x.size(); ++i) {
    pack.x[i] = fill_lanes([&](std::size_t lane) { return starts[lane][i]; });
  }
  return pack;
}

template <class Stepper>
class Points final : public OdeintSweep {
 public:
  Points(const Plan& plan, const Tile& tile, const std::vector<Run>& runs) {
    static_assert(kRunPoints % kLanes == 0);
    for (const std::size_t start : tile.grid_starts) {
      grids_.push_back(make_grid(plan, tile.points[start]));
    }
    for (const Run& run : runs) {
      for (std::size_t lane = 0; lane < kRunPoints; lane += kLanes) {
        packs_.push_back(make_pack(plan, tile.points, run.first + lane, run.grid));
      }
    }
  }

  double steps_per_second(std::size_t periods) override {
    double steps = 0.0;
    for (const Pack& pack : packs_) {
      steps += static_cast<double>(grids_[pack.grid].grid.steps * periods * kLanes);
    }
    const auto start = std::chrono::steady_clock::now();
    std::atomic<std::size_t> next = 0;
    on_all_cores([&] {
      for (std::size_t i = next++; i < packs_.size(); i = next++) {
        Pack& pack = packs_[i];
        if (pack.model.dynamic) {
          advance<Stepper, true>(grids_[pack.grid], periods, &pack);
        } else {
          advance<Stepper, false>(grids_[pack.grid], periods, &pack);
        }
      }
    });
    return steps / std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }

 private:
  std::vector<Grid> grids_;
  std::vector<Pack> packs_;
};

inline std::unique_ptr<OdeintSweep> make_points(const Plan& plan, const Tile& tile,
                                                const std::vector<Run>& runs,
                                                OdeintStepper stepper) {
  if (stepper == OdeintStepper::runge_kutta4) {
    return std::make_unique<Points<Generic>>(plan, tile, runs);
  }
  return std::make_unique<Points<Classic>>(plan, tile, runs);
}
