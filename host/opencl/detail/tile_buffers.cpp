#include "opencl/detail/tile_buffers.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <numbers>
#include <span>

#include "model/array.hpp"
#include "model/on_all_cores.hpp"
#include "plan/start_tangents.hpp"

namespace gearsweep {

Slots arrange_slots(const Tile& tile, std::size_t lanes) {
  Slots slots;
  slots.lanes = lanes;
  slots.slot_of.resize(tile.points.size());
  for (std::size_t grid = 0; grid < tile.grid_starts.size(); ++grid) {
    const bool last = grid + 1 == tile.grid_starts.size();
    const std::size_t end = last ? tile.points.size() : tile.grid_starts[grid + 1];
    for (std::size_t position = tile.grid_starts[grid]; position < end; ++position) {
      slots.slot_of[position] = slots.position.size();
      slots.position.push_back(position);
    }
    while (slots.position.size() % lanes != 0) slots.position.push_back(end - 1);
    slots.item_group.resize(slots.position.size() / lanes, static_cast<std::uint32_t>(grid));
  }
  return slots;
}

std::size_t table_width(const Study& study) {
  return study.model->phase_coefs.size() + 2 * study.selection.orders.size();
}

namespace {

// Cosines, then sines, of the orders' angles at a phase of the forcing period; whole turns are
// taken out of them while they are exact. The angle of an order that is the sum of the first one
// and of that before it, as of 1, 2, 3, is a sum, too.
void write_orders(const std::vector<double>& orders, double mesh_periods, double psi,
                  double* cosines) {
  double* const sines = cosines + orders.size();
  for (std::size_t i = 0; i < orders.size(); ++i) {
    if (i > 0 && orders[i] == orders[0] + orders[i - 1]) {
      cosines[i] = cosines[0] * cosines[i - 1] - sines[0] * sines[i - 1];
      sines[i] = sines[0] * cosines[i - 1] + cosines[0] * sines[i - 1];
      continue;
    }
    const double turns = orders[i] * mesh_periods * psi;
    const double angle = 2.0 * std::numbers::pi * (turns - std::round(turns));
    cosines[i] = std::cos(angle);
    sines[i] = std::sin(angle);
  }
}

// The rows of a phase grid as the kernels have them. Its segments end where the next begin.
void write_rows(const Plan& plan, std::size_t point, const PhaseGrid& grid, double* row) {
  const Study& study = plan.study();
  const std::size_t width = study.model->phase_coefs.size();
  const double mesh_periods = study.model->mesh_periods(plan.setting_of(point));
  const double* coefs = grid.coefs.data();
  double begin = 0.0;
  for (std::size_t segment = 0; segment < grid.segment_steps.size(); ++segment) {
    const std::uint32_t steps = grid.segment_steps[segment];
    const double fraction = grid.segment_fractions[segment];
    for (std::uint32_t i = 0; i <= 2 * steps; ++i) {
      std::copy_n(coefs, width, row);
      write_orders(study.selection.orders, mesh_periods, begin + 0.5 * i * fraction, row + width);
      coefs += width;
      row += table_width(study);
    }
    begin += steps * fraction;
  }
}

// Those of some points, in their order. On all cores: draws of a study have tables of their own.
std::vector<PhaseGrid> grids_of(const Plan& plan, std::span<const std::size_t> points) {
  std::vector<PhaseGrid> grids(points.size());
  std::vector<std::exception_ptr> failures(points.size());
  for_each_on_all_cores(points.size(), [&](std::size_t i) {
    try {
      grids[i] = plan.phase_grid_of(points[i]);
    } catch (...) {
      failures[i] = std::current_exception();
    }
  });
  for (const std::exception_ptr& failure : failures) {
    if (failure) std::rethrow_exception(failure);
  }
  return grids;
}

}  // namespace

GridTables make_grid_tables(const Plan& plan, const std::vector<std::size_t>& points) {
  constexpr std::size_t kHeld = 512;  // grids at a time, before they are packed
  const std::size_t width = table_width(plan.study());
  GridTables tables;
  std::size_t rows = 0;
  for (std::size_t first = 0; first < points.size(); first += kHeld) {
    const std::span<const std::size_t> some =
        std::span(points).subspan(first, std::min(kHeld, points.size() - first));
    const std::vector<PhaseGrid> grids = grids_of(plan, some);
    for (const PhaseGrid& grid : grids) {
      tables.grids.push_back({static_cast<sweep_uint>(rows),
                              static_cast<sweep_uint>(tables.segment_steps.size()),
                              static_cast<sweep_uint>(grid.segment_steps.size())});
      tables.segment_steps.insert(tables.segment_steps.end(), grid.segment_steps.begin(),
                                  grid.segment_steps.end());
      append(grid.segment_fractions, &tables.segment_fractions);
      tables.steps.push_back(grid.steps);
      rows += 2 * grid.steps + grid.segment_steps.size();
    }
    // Tables may be large, and mostly have one size: to copy them as they grow would take as long
    // as to make them.
    if (first == 0) tables.coefs.reserve(width * (rows / some.size() + 1) * points.size());
    tables.coefs.resize(width * rows);
    for_each_on_all_cores(some.size(), [&](std::size_t i) {
      write_rows(plan, some[i], grids[i],
                 tables.coefs.data() + width * tables.grids[first + i].first_stage);
    });
  }
  return tables;
}

std::vector<std::uint32_t> swept_rows(const Plan& plan) {
  std::vector<std::uint32_t> rows(plan.study().model->parameters.size(), NOT_SWEPT);
  std::uint32_t row = 0;
  for (const std::size_t parameter : plan.points().differing()) rows[parameter] = row++;
  return rows;
}

std::vector<double> swept_values(const Plan& plan, const Tile& tile, const Slots& slots) {
  const std::vector<std::size_t>& parameters = plan.points().differing();
  const std::size_t count = slots.position.size();
  std::vector<double> values(parameters.size() * count);
  ModelSetting setting = plan.study().setting;
  for (std::size_t slot = 0; slot < count && !parameters.empty(); ++slot) {
    plan.points().set(tile.points[slots.position[slot]], &setting);
    for (std::size_t row = 0; row < parameters.size(); ++row) {
      values[row * count + slot] = setting.parameters[parameters[row]];
    }
  }
  return values;
}

std::vector<double> first_tangents(const Study& study, std::size_t slot_count) {
  std::vector<double> out;
  for (const double number : start_tangents(study.selection.tangent_count(), *study.model)) {
    out.insert(out.end(), slot_count, number);
  }
  return out;
}

std::vector<double> spread_states(const std::vector<double>& states, std::size_t state_count,
                                  const Slots& slots) {
  std::vector<double> out;
  out.reserve(state_count * slots.position.size());
  for (std::size_t state = 0; state < state_count; ++state) {
    for (const std::size_t position : slots.position) {
      out.push_back(states[position * state_count + state]);
    }
  }
  return out;
}

std::vector<double> gather_points(const std::vector<double>& values, const Slots& slots) {
  const std::size_t slot_count = slots.position.size();
  std::vector<double> out;
  out.reserve(values.size() / slot_count * slots.slot_of.size());
  for (const std::size_t slot : slots.slot_of) {
    for (std::size_t i = slot; i < values.size(); i += slot_count) out.push_back(values[i]);
  }
  return out;
}

std::vector<double> gather_components(const std::vector<double>& values, const Slots& slots) {
  const std::size_t slot_count = slots.position.size();
  std::vector<double> out;
  out.reserve(values.size() / slot_count * slots.slot_of.size());
  for (std::size_t first = 0; first < values.size(); first += slot_count) {
    for (const std::size_t slot : slots.slot_of) out.push_back(values[first + slot]);
  }
  return out;
}

}  // namespace gearsweep
