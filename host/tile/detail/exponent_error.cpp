#include "tile/detail/exponent_error.hpp"

#include <cmath>
#include <optional>

#include "model/on_all_cores.hpp"
#include "sweep_types.h"
#include "tile/detail/orbit_newton.hpp"
#include "tile/subset.hpp"

namespace gearsweep {
namespace {

// Points of a tile that are on periodic orbits.
struct OnOrbits {
  std::vector<std::size_t> positions;  // in the tile, those of one phase grid together
  std::vector<std::uint32_t> lengths;  // [position] periods after which the orbit comes back
  std::vector<double> states;          // [position][state]
};

template <class Chosen>
OnOrbits periodic_points(const Study& study, const TileResult& result, const Chosen& is_chosen) {
  const std::size_t points = result.status.size();
  OnOrbits out;
  for (std::size_t i = 0; i < points; ++i) {
    const double period = result.output_table()[study.selection.exponent_error->period][i];
    if (result.status[i] != STATUS_ok || !(period >= 1.0 && period <= ORBIT_LONGEST)) continue;
    if (!is_chosen(i)) continue;
    out.positions.push_back(i);
    out.lengths.push_back(static_cast<std::uint32_t>(period));
  }
  out.states = end_states(result, out.positions);
  return out;
}

// [position]: the largest exponent by the multipliers of the return map at the state, per
// dimensionless time. Nothing when the callback asked to stop.
std::optional<std::vector<double>> largest_exponents(const Plan& plan, const Tile& tile,
                                                     const OnOrbits& points, OrbitEngine* engine,
                                                     const RoundCallback& after_round) {
  if (points.positions.empty()) return std::vector<double>();
  const Model& model = *plan.study().model;
  const std::size_t states = model.states.size();
  const Tile subset = subset_of(plan, tile, points.positions, 1);
  const std::optional<ReturnMaps> maps =
      engine->return_maps(plan, subset, points.states, points.lengths, after_round);
  if (!maps) return std::nullopt;
  const Array2 derivatives(maps->derivatives, states * states);
  const double lost = lost_multiplier(!model.surfaces.empty(), plan.study().integrate.fp64);
  std::vector<double> exponents(points.positions.size());
  for_each_on_all_cores(exponents.size(), [&](std::size_t i) {
    const double time = points.lengths[i] * model.period(plan.setting_of(subset.points[i]));
    exponents[i] = largest_log_multiplier(derivatives[i], states, lost) / time;
  });
  return exponents;
}

// Where the steps' error falls by its order, steps of twice the length change 15 times as much as
// their own are off by. Where teeth meet at a grazing angle it does not fall evenly: this many
// times what they change is more than the error at 99 of 100 points.
constexpr double kSafety = 4.0;

// Both may be minus infinity.
double apart(double a, double b) { return a == b ? 0.0 : std::abs(a - b); }

}  // namespace

bool add_exponent_errors(const Plan& plan, const Plan& orbit_plan, const Tile& tile,
                         const std::vector<std::uint8_t>& has_stopped,
                         const std::vector<std::uint8_t>& is_orbit, OrbitEngine* engine,
                         const RoundCallback& after_round, TileResult* result) {
  const Study& study = plan.study();
  if (engine == nullptr || !study.selection.exponent_error) return true;
  const Array2<double> outputs = result->output_table();
  const std::span<const double> told = outputs[study.selection.exponent_error->exponent];
  const std::span<double> error = outputs[study.selection.exponent_error->error];

  std::vector<double> exponents(told.begin(), told.end());  // [point] of the return map
  const auto points_with = [&](const std::vector<std::uint8_t>& mark, std::uint8_t value) {
    return periodic_points(study, *result, [&](std::size_t i) { return mark[i] == value; });
  };
  const OnOrbits going_on = points_with(has_stopped, 0);
  const auto own = largest_exponents(plan, tile, going_on, engine, after_round);
  if (!own) return false;
  for (std::size_t i = 0; i < own->size(); ++i) exponents[going_on.positions[i]] = (*own)[i];

  const auto add = [&](const Plan& longer, const OnOrbits& points) {
    const auto coarse = largest_exponents(longer, tile, points, engine, after_round);
    if (!coarse) return false;
    for (std::size_t i = 0; i < coarse->size(); ++i) {
      const std::size_t point = points.positions[i];
      error[point] +=
          apart(exponents[point], told[point]) + kSafety * apart((*coarse)[i], exponents[point]);
    }
    return true;
  };
  return add(orbit_plan.with_longer_steps(), points_with(is_orbit, 1)) &&
         add(plan.with_longer_steps(), points_with(is_orbit, 0));
}

}  // namespace gearsweep
