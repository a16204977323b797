#include "opencl/detail/orbit_kernels.hpp"

#include <algorithm>

#include "opencl/detail/buffer_plan.hpp"

namespace gearsweep {
namespace {

// A step that carries a tangent vector along each state, in steps of the state alone (measured for
// gear5).
constexpr double kCostOfDerivative = 8.0;

// The identity in each slot: [column][row][slot].
std::vector<double> identities(std::size_t states, std::size_t slot_count) {
  std::vector<double> out;
  out.reserve(states * states * slot_count);
  for (std::size_t i = 0; i < states * states; ++i) {
    out.insert(out.end(), slot_count, i % (states + 1) == 0 ? 1.0 : 0.0);
  }
  return out;
}

// One number for each point: [slot].
std::vector<double> spread_numbers(const std::vector<std::uint32_t>& numbers, const Slots& slots) {
  return spread_states({numbers.begin(), numbers.end()}, 1, slots);
}

// numbers: [item][period][state][lane], in the device's precision.
Sections sections_of(std::shared_ptr<const void> numbers, bool fp64, std::size_t states,
                     const Slots& slots) {
  const std::size_t of_item = (ORBIT_LONGEST + 1) * states * slots.lanes;
  std::vector<std::size_t> first;
  for (const std::size_t slot : slots.slot_of) {
    first.push_back(slot / slots.lanes * of_item + slot % slots.lanes);
  }
  return {std::move(numbers), fp64, std::move(first), slots.lanes, states};
}

Window window_of_rounds() { return {0, 0, 1, 0, false}; }

}  // namespace

OrbitKernels::OrbitKernels(const Study& study, const cl::Program& sweep, Launcher* launcher)
    : launcher_(launcher),
      program_(launcher->program(study, "orbit.cl")),
      follow_(program_, "follow"),
      measure_(program_, "measure"),
      extrapolate_(program_, "extrapolate"),
      return_map_linearized_(program_, "return_map_linearized"),
      replay_(sweep, "replay"),
      finish_(sweep, "finish") {}

std::optional<Approach> OrbitKernels::approach(const Plan& plan, const Tile& tile,
                                               const std::vector<double>& states,
                                               std::size_t periods,
                                               const std::vector<std::uint32_t>& excluded,
                                               const NearReturn& near,
                                               const RoundCallback& after_round) {
  return launcher_->guard(tile, [&]() -> std::optional<Approach> {
    const TileInputs inputs = launcher_->prepare(plan, tile);
    const std::size_t state_count = plan.study().model->states.size();
    const ApproachBuffers sizes = approach_buffers(plan.study(), inputs.slots.position.size());
    const cl::Buffer state =
        launcher_->upload(spread_states(states, state_count, inputs.slots), CL_MEM_READ_WRITE);
    const std::vector<std::uint32_t> whole(tile.points.size(), static_cast<std::uint32_t>(periods));
    const cl::Buffer periods_of_points =
        launcher_->upload(spread_numbers(whole, inputs.slots), CL_MEM_READ_ONLY);
    const cl::Buffer sections = launcher_->allocate(sizes.sections);
    const cl::Buffer ranges = launcher_->allocate(sizes.ranges);
    const cl::Buffer lengths =
        launcher_->upload(spread_numbers(excluded, inputs.slots), CL_MEM_READ_WRITE);
    const cl::Buffer guesses = launcher_->allocate(sizes.guesses);
    launcher_->bind(&follow_, inputs, state, periods_of_points,
                    static_cast<cl_uint>(ORBIT_LONGEST - periods), sections);
    launcher_->bind(&measure_, inputs, state, sections, near.tolerance, ranges);
    launcher_->bind(&extrapolate_, state, sections, ranges, near.near,
                    static_cast<cl_uint>(periods), lengths, guesses);
    const Window rounds = window_of_rounds();
    if (!launcher_->run_rounds(&follow_, rounds, inputs, periods - 1, after_round) ||
        !launcher_->run_rounds(&measure_, rounds, inputs, 1, after_round)) {
      return std::nullopt;
    }
    launcher_->launch(&extrapolate_, round_of(rounds, inputs.slots.items(), 0, periods));
    const auto [ends, moved, orbits, numbers] = launcher_->download({{state, sizes.state},
                                                                     {ranges, sizes.ranges},
                                                                     {guesses, sizes.guesses},
                                                                     {lengths, sizes.lengths}});
    Approach found;
    found.states = gather_points(ends, inputs.slots);
    found.sections = sections_of(launcher_->view(sections, sizes.sections),
                                 plan.study().integrate.fp64, state_count, inputs.slots);
    found.ranges = gather_points(moved, inputs.slots);
    found.guesses = gather_points(orbits, inputs.slots);
    for (const double length : gather_points(numbers, inputs.slots)) {
      found.lengths.push_back(static_cast<std::uint32_t>(length));
    }
    return found;
  });
}

bool OrbitKernels::run_lengths(cl::Kernel* kernel, const Plan& plan, const Tile& tile,
                               const TileInputs& inputs, const std::vector<std::uint32_t>& lengths,
                               double cost, const RoundCallback& after_round) {
  const std::size_t longest = *std::max_element(lengths.begin(), lengths.end());
  // Most points are done before the longest; what they all took is told in the end.
  const auto in_between = [&](double) { return after_round(0.0); };
  return launcher_->run_rounds(kernel, window_of_rounds(), inputs, longest, in_between) &&
         after_round(cost * plan.steps_of(tile.points, lengths));
}

std::optional<Sections> OrbitKernels::follow(const Plan& plan, const Tile& tile,
                                             const std::vector<double>& states,
                                             const std::vector<std::uint32_t>& lengths,
                                             const RoundCallback& after_round) {
  return launcher_->guard(tile, [&]() -> std::optional<Sections> {
    const TileInputs inputs = launcher_->prepare(plan, tile);
    const std::size_t state_count = plan.study().model->states.size();
    // An approach has these buffers, too.
    const ApproachBuffers sizes = approach_buffers(plan.study(), inputs.slots.position.size());
    const cl::Buffer state =
        launcher_->upload(spread_states(states, state_count, inputs.slots), CL_MEM_READ_WRITE);
    const cl::Buffer periods =
        launcher_->upload(spread_numbers(lengths, inputs.slots), CL_MEM_READ_ONLY);
    const cl::Buffer sections = launcher_->allocate(sizes.sections);
    launcher_->bind(&follow_, inputs, state, periods, cl_uint{0}, sections);
    if (!run_lengths(&follow_, plan, tile, inputs, lengths, 1.0, after_round)) return std::nullopt;
    return sections_of(launcher_->view(sections, sizes.sections), plan.study().integrate.fp64,
                       state_count, inputs.slots);
  });
}

std::optional<ReturnMaps> OrbitKernels::return_maps(const Plan& plan, const Tile& tile,
                                                    const std::vector<double>& states,
                                                    const std::vector<std::uint32_t>& lengths,
                                                    const RoundCallback& after_round) {
  return launcher_->guard(tile, [&]() -> std::optional<ReturnMaps> {
    const TileInputs inputs = launcher_->prepare(plan, tile);
    const std::size_t slot_count = inputs.slots.position.size();
    const std::size_t state_count = plan.study().model->states.size();
    const ReturnMapBuffers sizes = return_map_buffers(plan.study(), slot_count);
    const cl::Buffer state =
        launcher_->upload(spread_states(states, state_count, inputs.slots), CL_MEM_READ_WRITE);
    const cl::Buffer periods =
        launcher_->upload(spread_numbers(lengths, inputs.slots), CL_MEM_READ_ONLY);
    const cl::Buffer derivative =
        launcher_->upload(identities(state_count, slot_count), CL_MEM_READ_WRITE);
    launcher_->bind(&return_map_linearized_, inputs, state, periods, derivative);
    if (!run_lengths(&return_map_linearized_, plan, tile, inputs, lengths, kCostOfDerivative,
                     after_round)) {
      return std::nullopt;
    }
    const auto [ends, derivatives] =
        launcher_->download({{state, sizes.state}, {derivative, sizes.derivative}});
    return ReturnMaps{gather_points(ends, inputs.slots), gather_points(derivatives, inputs.slots)};
  });
}

std::optional<TileResult> OrbitKernels::replay(const Plan& plan, const Tile& tile,
                                               const std::vector<double>& states,
                                               std::size_t length,
                                               const std::vector<double>& log_stretchings,
                                               const Window& window,
                                               const RoundCallback& after_round) {
  return launcher_->guard(tile, [&]() -> std::optional<TileResult> {
    const TileInputs inputs = launcher_->prepare(plan, tile);
    const Study& study = plan.study();
    const ReplayBuffers sizes = replay_buffers(study, length, inputs.slots.position.size());
    const cl::Buffer state = launcher_->upload(
        spread_states(states, study.model->states.size(), inputs.slots), CL_MEM_READ_WRITE);
    const cl::Buffer log_stretching = launcher_->upload(
        spread_states(log_stretchings, study.selection.tangent_count(), inputs.slots),
        CL_MEM_READ_ONLY);
    const cl::Buffer sections = launcher_->allocate(sizes.sections);
    const cl::Buffer accumulators = launcher_->allocate(sizes.accumulators);
    const cl::Buffer outputs = launcher_->allocate(sizes.outputs);
    launcher_->bind(&replay_, inputs, state, log_stretching, static_cast<cl_uint>(length), sections,
                    accumulators);
    launcher_->bind(&finish_, accumulators, outputs);
    const std::size_t items = inputs.slots.items();
    launcher_->launch(&replay_, round_of(window, items, window.record, 0));
    launcher_->launch(&finish_, round_of(window, items, 0, window.record));
    if (!after_round(static_cast<double>(length) * inputs.steps_per_period)) return std::nullopt;

    const auto [ends, numbers] =
        launcher_->download({{state, sizes.state}, {outputs, sizes.outputs}});
    TileResult result;
    result.status.assign(tile.points.size(), STATUS_ok);
    result.final_states = gather_points(ends, inputs.slots);
    result.outputs = gather_components(numbers, inputs.slots);
    return result;
  });
}

}  // namespace gearsweep
