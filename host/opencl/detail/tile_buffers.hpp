// What a tile's launches read and write, packed for the device.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "opencl/detail/cl.hpp"
#include "plan/plan.hpp"
#include "sweep_types.h"

namespace gearsweep {

// A tile's points in the lanes of work-items: slot s is lane s % lanes of item s / lanes. Items
// never mix phase grids; spare lanes repeat the last point of their grid.
struct Slots {
  std::vector<std::size_t> position;      // in the tile, of each slot
  std::vector<std::size_t> slot_of;       // of each position in the tile
  std::vector<std::uint32_t> item_group;  // group of the tile's points (grid_starts) of each item
  std::size_t lanes = 1;
  std::size_t items() const { return item_group.size(); }
};

Slots arrange_slots(const Tile& tile, std::size_t lanes);

// Phase grids, one after the other.
struct GridTables {
  std::vector<SweepGrid> grids;
  std::vector<std::uint32_t> segment_steps;
  std::vector<double> segment_fractions;
  std::vector<double> coefs;
  std::vector<std::size_t> steps;  // of a period, per grid
};

// Numbers of a row of `coefs`: the model's phase coefficients, then cosines and sines of the orders
// that the study asks for (kernels/observables/orders.h).
std::size_t table_width(const Study& study);

// Those of these points.
GridTables make_grid_tables(const Plan& plan, const std::vector<std::size_t>& points);

// Each parameter's row among the swept ones, or NOT_SWEPT.
std::vector<std::uint32_t> swept_rows(const Plan& plan);

// [swept parameter][slot]: in the order of PointSource::differing().
std::vector<double> swept_values(const Plan& plan, const Tile& tile, const Slots& slots);

// [vector][state][slot]: start_tangents() of plan/, the same for all points.
std::vector<double> first_tangents(const Study& study, std::size_t slot_count);

// [state][slot] from [point of the tile][state].
std::vector<double> spread_states(const std::vector<double>& states, std::size_t state_count,
                                  const Slots& slots);

// From [component][slot] to the tile's points: [point][component], and [component][point].
std::vector<double> gather_points(const std::vector<double>& values, const Slots& slots);
std::vector<double> gather_components(const std::vector<double>& values, const Slots& slots);

}  // namespace gearsweep
