#include "opencl/orbit_kernels.hpp"

#include <algorithm>
#include <cmath>

namespace gearsweep {
namespace {

// A step that carries a tangent vector along each state, in steps of the state alone (measured for
// gear5).
constexpr double kCostOfDerivative = 8.0;

cl::Program orbit_program(const Study& study, Launcher* launcher) {
  Study bare = study;
  bare.selection = {};  // what is observed does not matter here
  return launcher->program(bare, "orbit.cl");
}

// The identity in each slot: [column][row][slot].
std::vector<double> identities(std::size_t states, std::size_t slot_count) {
  std::vector<double> out;
  out.reserve(states * states * slot_count);
  for (std::size_t i = 0; i < states * states; ++i) {
    out.insert(out.end(), slot_count, i % (states + 1) == 0 ? 1.0 : 0.0);
  }
  return out;
}

// Steps of the states alone; periods: [group].
double steps_of_maps(const Plan& plan, const Tile& tile,
                     const std::vector<std::uint32_t>& periods) {
  double steps = 0.0;
  for (std::size_t group = 0; group < periods.size(); ++group) {
    const std::size_t first = tile.grid_starts[group];
    const bool is_last = group + 1 == periods.size();
    const std::size_t end = is_last ? tile.points.size() : tile.grid_starts[group + 1];
    steps +=
        static_cast<double>((end - first) * periods[group] * plan.steps_of(tile.points[first]));
  }
  return steps;
}

Window window_of_rounds() { return {0, 0, 1, 0, false}; }

}  // namespace

OrbitKernels::OrbitKernels(const Study& study, const cl::Program& sweep, Launcher* launcher)
    : launcher_(launcher),
      program_(orbit_program(study, launcher)),
      approach_(program_, "approach"),
      return_map_(program_, "return_map"),
      replay_(sweep, "replay"),
      finish_(sweep, "finish") {}

std::optional<Approach> OrbitKernels::approach(const Plan& plan, const Tile& tile,
                                               const std::vector<double>& states,
                                               std::size_t periods, double near,
                                               const RoundCallback& after_round) {
  return launcher_->guard(
      tile, [&] { return approach_tile(plan, tile, states, periods, near, after_round); });
}

std::optional<ReturnMaps> OrbitKernels::return_maps(const Plan& plan, const Tile& tile,
                                                    const std::vector<double>& states,
                                                    const std::vector<std::uint32_t>& periods,
                                                    const RoundCallback& after_round) {
  return launcher_->guard(tile, [&] { return map_tile(plan, tile, states, periods, after_round); });
}

std::optional<TileResult> OrbitKernels::replay(
    const Plan& plan, const Tile& tile, const std::vector<double>& states, std::size_t length,
    const std::vector<double>& growths, const Window& window, const RoundCallback& after_round) {
  return launcher_->guard(
      tile, [&] { return replay_tile(plan, tile, states, length, growths, window, after_round); });
}

std::optional<Approach> OrbitKernels::approach_tile(const Plan& plan, const Tile& tile,
                                                    const std::vector<double>& states,
                                                    std::size_t periods, double near,
                                                    const RoundCallback& after_round) {
  const TileInputs inputs = launcher_->prepare(plan, tile);
  const std::size_t slot_count = inputs.slots.position.size();
  const std::size_t state_count = plan.study().model->states.size();
  const cl::Buffer state =
      launcher_->upload(spread_states(states, state_count, inputs.slots), CL_MEM_READ_WRITE);
  const cl::Buffer start = launcher_->allocate(state_count * slot_count);
  const cl::Buffer returns = launcher_->allocate(slot_count);
  cl_uint argument = Launcher::set_inputs(&approach_, inputs);
  approach_.setArg(argument++, state);
  launcher_->set_number(&approach_, argument++, near);
  approach_.setArg(argument++, start);
  approach_.setArg(argument++, returns);
  if (!launcher_->run_rounds(&approach_, window_of_rounds(), inputs, periods, after_round)) {
    return std::nullopt;
  }
  Approach found;
  found.states = gather_points(launcher_->download(state, state_count * slot_count), inputs.slots);
  const std::vector<double> bits =
      gather_points(launcher_->download(returns, slot_count), inputs.slots);
  for (std::size_t i = 0; i < bits.size(); ++i) {
    // An item whose points have all diverged leaves its buffer as it was.
    const bool diverged = std::isnan(found.states[i * state_count]);
    found.returns.push_back(diverged ? 0 : static_cast<std::uint32_t>(bits[i]));
  }
  return found;
}

std::optional<ReturnMaps> OrbitKernels::map_tile(const Plan& plan, const Tile& tile,
                                                 const std::vector<double>& states,
                                                 const std::vector<std::uint32_t>& periods,
                                                 const RoundCallback& after_round) {
  const TileInputs inputs = launcher_->prepare(plan, tile);
  const std::size_t slot_count = inputs.slots.position.size();
  const std::size_t state_count = plan.study().model->states.size();
  const cl::Buffer state =
      launcher_->upload(spread_states(states, state_count, inputs.slots), CL_MEM_READ_WRITE);
  const cl::Buffer derivative =
      launcher_->upload(identities(state_count, slot_count), CL_MEM_READ_WRITE);
  std::vector<std::uint32_t> item_periods;
  for (const std::uint32_t group : inputs.slots.item_group) item_periods.push_back(periods[group]);
  const cl::Buffer lengths = launcher_->upload(item_periods);
  cl_uint argument = Launcher::set_inputs(&return_map_, inputs);
  return_map_.setArg(argument++, state);
  return_map_.setArg(argument++, lengths);
  return_map_.setArg(argument++, derivative);
  const std::size_t longest = *std::max_element(periods.begin(), periods.end());
  // Most points are done before the longest; what they all took is told in the end.
  const auto in_between = [&](double) { return after_round(0.0); };
  if (!launcher_->run_rounds(&return_map_, window_of_rounds(), inputs, longest, in_between) ||
      !after_round(kCostOfDerivative * steps_of_maps(plan, tile, periods))) {
    return std::nullopt;
  }
  const std::size_t numbers = state_count * state_count * slot_count;
  return ReturnMaps{
      gather_points(launcher_->download(state, state_count * slot_count), inputs.slots),
      gather_points(launcher_->download(derivative, numbers), inputs.slots)};
}

std::optional<TileResult> OrbitKernels::replay_tile(
    const Plan& plan, const Tile& tile, const std::vector<double>& states, std::size_t length,
    const std::vector<double>& growths, const Window& window, const RoundCallback& after_round) {
  const Selection& selection = plan.study().selection;
  const TileInputs inputs = launcher_->prepare(plan, tile);
  const std::size_t items = inputs.slots.items();
  const std::size_t slot_count = inputs.slots.position.size();
  const std::size_t state_count = plan.study().model->states.size();
  const cl::Buffer state =
      launcher_->upload(spread_states(states, state_count, inputs.slots), CL_MEM_READ_WRITE);
  const cl::Buffer accumulators = launcher_->allocate(selection.accumulator_count() * slot_count);
  const cl::Buffer outputs = launcher_->allocate(selection.output_count() * slot_count);
  const cl::Buffer growth = launcher_->upload(
      spread_states(growths, selection.tangent_count(), inputs.slots), CL_MEM_READ_ONLY);
  const cl::Buffer sections = launcher_->allocate(length * state_count * slot_count);
  cl_uint argument = Launcher::set_inputs(&replay_, inputs);
  replay_.setArg(argument++, state);
  replay_.setArg(argument++, growth);
  replay_.setArg(argument++, static_cast<cl_uint>(length));
  replay_.setArg(argument++, sections);
  replay_.setArg(argument++, accumulators);
  replay_.setArg(0, round_of(window, items, window.record, 0));
  launcher_->launch(&replay_, items);
  finish_.setArg(0, round_of(window, items, 0, window.record));
  finish_.setArg(1, accumulators);
  finish_.setArg(2, outputs);
  launcher_->launch(&finish_, items);
  if (!after_round(static_cast<double>(length) * inputs.steps_per_period)) return std::nullopt;

  TileResult result;
  result.status.assign(tile.points.size(), STATUS_ok);
  result.final_states =
      gather_points(launcher_->download(state, state_count * slot_count), inputs.slots);
  result.outputs = gather_components(
      launcher_->download(outputs, selection.output_count() * slot_count), inputs.slots);
  return result;
}

}  // namespace gearsweep
