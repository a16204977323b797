#include "opencl/detail/tile_buffers.hpp"

#include <cmath>
#include <numbers>

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
// taken out of them while they are exact.
void append_orders(const std::vector<double>& orders, double mesh_periods, double psi,
                   std::vector<double>* row) {
  std::vector<double> angles;
  for (const double order : orders) {
    const double turns = order * mesh_periods * psi;
    angles.push_back(2.0 * std::numbers::pi * (turns - std::round(turns)));
  }
  for (const double angle : angles) row->push_back(std::cos(angle));
  for (const double angle : angles) row->push_back(std::sin(angle));
}

// The rows of a phase grid as the kernels have them where orders are asked for.
std::vector<double> table_rows(const Plan& plan, std::size_t point, const PhaseGrid& grid) {
  const Study& study = plan.study();
  const std::size_t width = study.model->phase_coefs.size();
  const ModelSetting setting = plan.setting_of(point);
  const std::vector<double> bounds = segment_bounds(*study.model, setting);
  const double mesh_periods = study.model->mesh_periods(setting);
  std::vector<double> rows;
  auto coefs = grid.coefs.begin();
  for (std::size_t segment = 0; segment < grid.segment_steps.size(); ++segment) {
    const std::uint32_t last = 2 * grid.segment_steps[segment];
    for (std::uint32_t row = 0; row <= last; ++row) {
      rows.insert(rows.end(), coefs, coefs + static_cast<std::ptrdiff_t>(width));
      coefs += static_cast<std::ptrdiff_t>(width);
      const double psi = row == last
                             ? bounds[segment + 1]
                             : bounds[segment] + 0.5 * row * grid.segment_fractions[segment];
      append_orders(study.selection.orders, mesh_periods, psi, &rows);
    }
  }
  return rows;
}

// At most, of grids with so many segments. Tables may be large: to copy them as they grow would
// take as long as to make them.
std::size_t rows_of(const Plan& plan, const std::vector<std::size_t>& points,
                    std::size_t segments) {
  std::size_t rows = 0;
  for (const std::size_t point : points) rows += 2 * (plan.steps_of(point) + segments) + segments;
  return rows;
}

}  // namespace

GridTables make_grid_tables(const Plan& plan, const std::vector<std::size_t>& points) {
  const std::size_t width = table_width(plan.study());
  GridTables tables;
  const auto append = [](const auto& from, auto& to) {
    to.insert(to.end(), from.begin(), from.end());
  };
  plan.for_each_phase_grid(points, [&](std::size_t point, const PhaseGrid& grid) {
    if (tables.grids.empty()) {
      tables.coefs.reserve(width * rows_of(plan, points, grid.segment_steps.size()));
    }
    tables.grids.push_back({static_cast<sweep_uint>(tables.coefs.size() / width),
                            static_cast<sweep_uint>(tables.segment_steps.size()),
                            static_cast<sweep_uint>(grid.segment_steps.size())});
    append(grid.segment_steps, tables.segment_steps);
    append(grid.segment_fractions, tables.segment_fractions);
    if (plan.study().selection.orders.empty()) {
      append(grid.coefs, tables.coefs);
    } else {
      append(table_rows(plan, point, grid), tables.coefs);
    }
    tables.steps.push_back(grid.steps);
  });
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
