#include "opencl/opencl_engine.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "model/array.hpp"
#include "model/error.hpp"
#include "opencl/detail/buffer_plan.hpp"
#include "opencl/detail/cl.hpp"
#include "opencl/detail/launcher.hpp"
#include "opencl/detail/orbit_kernels.hpp"
#include "opencl/detail/tile_buffers.hpp"
#include "opencl/detail/tile_memory.hpp"
#include "opencl/device.hpp"

namespace gearsweep {
namespace {

constexpr std::size_t kMaxSeriesBytes = std::size_t{256} << 20U;  // of a tile's samples
// A GPU's compute unit has 512 to 2048 points in flight. A launch takes as long for few points as
// for these, so a tile has enough for a while after most of its points have stopped on orbits.
constexpr std::size_t kMinOfGpuUnit = 1024, kPreferredOfGpuUnit = 4096;

class OpenClEngine final : public Engine {
 public:
  OpenClEngine(const Study& study, std::shared_ptr<OpenDevice> open)
      : launcher_(study, std::move(open)), program_(launcher_.program(study, "sweep.cl")) {
    settle_ = cl::Kernel(program_, "settle");
    record_ = cl::Kernel(program_, "record");
    if (study.selection.tangent_count() > 0) align_ = cl::Kernel(program_, "align");
    finish_ = cl::Kernel(program_, "finish");
    if (looks_for_orbits(study)) {
      orbits_ = std::make_unique<OrbitKernels>(study, program_, &launcher_);
    }
    series_bytes_per_point_ =
        study.selection.poincare.size() * study.integrate.record * launcher_.scalar_bytes();
  }

  EngineInfo info() const override {
    const DeviceInfo& device = launcher_.device();
    return {fmt::format("{} ({})", device.name, device.platform), device.driver,
            launcher_.build_options()};
  }

  DeviceMemory memory() const override {
    const DeviceInfo& device = launcher_.device();
    return {device.memory, device.largest_buffer, device.shares_host_memory};
  }

  TileMemory tile_memory(const Plan& plan, const Tile& tile) const override {
    return max_of_tile(plan, tile, {launcher_.lanes(), launcher_.scalar_bytes()});
  }

  double kernel_seconds() const override { return launcher_.clock().seconds(); }

  std::size_t min_tile() const override {
    const DeviceInfo& device = launcher_.device();
    const std::size_t filling = 4 * launcher_.local_size() * launcher_.lanes();
    return std::min(preferred_tile(),
                    device.compute_units * (device.is_cpu ? filling : kMinOfGpuUnit));
  }

  std::size_t preferred_tile() const override {
    const DeviceInfo& device = launcher_.device();
    const std::size_t points = device.is_cpu ? 6144 : device.compute_units * kPreferredOfGpuUnit;
    if (series_bytes_per_point_ == 0) return points;
    return std::clamp(kMaxSeriesBytes / series_bytes_per_point_, std::size_t{64}, points);
  }

  // A CPU has the host's part of a tile on the same cores, and copies wait for the launches of
  // other tiles: of two, too often neither is in a kernel.
  std::size_t tiles_at_once() const override { return launcher_.device().is_cpu ? 3 : 2; }

  std::optional<std::vector<double>> rows(const Plan& plan, std::size_t point,
                                          const std::vector<double>& initial, std::size_t settle,
                                          std::size_t record,
                                          const RoundCallback& after_round) override {
    const Tile tile = {{point}, {0}, 0.0};
    return launcher_.guard(
        tile, [&] { return trace_rows(plan, tile, initial, settle, record, after_round); });
  }

  OrbitEngine* orbits() override { return orbits_.get(); }

  std::optional<TileResult> compute(const Plan& plan, const Tile& tile,
                                    const std::vector<double>& initial, const Window& window,
                                    const RoundCallback& after_round) override {
    return launcher_.guard(tile,
                           [&] { return compute_tile(plan, tile, initial, window, after_round); });
  }

 private:
  // What a tile's launches change.
  struct Buffers {
    cl::Buffer state, tangents, accumulators, series, outputs;
  };

  std::optional<TileResult> compute_tile(const Plan& plan, const Tile& tile,
                                         const std::vector<double>& initial, const Window& window,
                                         const RoundCallback& after_round) {
    const Study& study = plan.study();
    const TileInputs inputs = launcher_.prepare(plan, tile);
    const std::size_t slot_count = inputs.slots.position.size();
    const RecordBuffers sizes = record_buffers(study, window.samples, slot_count);
    Buffers buffers;
    buffers.state = launcher_.upload(
        spread_states(initial, study.model->states.size(), inputs.slots), CL_MEM_READ_WRITE);
    buffers.tangents = launcher_.upload(first_tangents(study, slot_count), CL_MEM_READ_WRITE);
    buffers.accumulators = launcher_.allocate(sizes.accumulators);
    buffers.outputs = launcher_.allocate(sizes.outputs);
    buffers.series = launcher_.allocate(sizes.series);
    const bool with_tangents = study.selection.tangent_count() > 0;
    launcher_.bind(&settle_, inputs, buffers.state);
    if (with_tangents) launcher_.bind(&align_, inputs, buffers.state, buffers.tangents);
    launcher_.bind(&record_, inputs, buffers.state, buffers.tangents, buffers.accumulators,
                   buffers.series);
    launcher_.bind(&finish_, buffers.accumulators, buffers.outputs);

    const std::size_t aligned =
        with_tangents ? std::min(study.integrate.warm_up, window.settle) : 0;
    const auto advance = [&](cl::Kernel* kernel, std::size_t periods) {
      return launcher_.run_rounds(kernel, window, inputs, periods, after_round);
    };
    if (!advance(&settle_, window.settle - aligned) || !advance(&align_, aligned) ||
        !advance(&record_, window.record)) {
      return std::nullopt;
    }
    launcher_.launch(&finish_, round_of(window, inputs.slots.items(), 0, window.record));
    return collect(study, window, inputs.slots, sizes, buffers);
  }

  std::optional<std::vector<double>> trace_rows(const Plan& plan, const Tile& tile,
                                                const std::vector<double>& initial,
                                                std::size_t settle, std::size_t record,
                                                const RoundCallback& after_round) {
    constexpr std::size_t kRowsAtOnce = 65536;
    const std::size_t states = plan.study().model->states.size();
    const TileInputs inputs = launcher_.prepare(plan, tile);
    const Slots& slots = inputs.slots;
    const cl::Buffer state =
        launcher_.upload(spread_states(initial, states, slots), CL_MEM_READ_WRITE);
    launcher_.bind(&settle_, inputs, state);
    if (!launcher_.run_rounds(&settle_, {}, inputs, settle, after_round)) return std::nullopt;

    cl::Kernel trace(launcher_.program(plan.study(), "trace.cl"), "trace");
    const PhaseGrid grid = plan.phase_grid_of(tile.points.front());
    const std::size_t rows_per_period = grid.steps + grid.segment_steps.size();
    const std::size_t at_once = std::max<std::size_t>(1, kRowsAtOnce / rows_per_period);
    const std::size_t numbers = rows_per_period * states * slots.position.size();
    const cl::Buffer rows = launcher_.allocate(numbers * std::min(at_once, record));
    launcher_.bind(&trace, inputs, state, rows);
    std::vector<double> out;
    for (std::size_t done = 0; done < record;) {
      const std::size_t now = std::min(at_once, record - done);
      launcher_.launch(&trace, round_of({}, slots.items(), now, done));
      const auto [end, walked] =
          launcher_.download({{state, states * slots.position.size()}, {rows, numbers * now}});
      if (std::isnan(end[0])) break;
      const std::vector<double> block = gather_points(walked, slots);
      out.insert(out.end(), block.begin(), block.end());
      done += now;
      if (!after_round(inputs.steps_per_period * static_cast<double>(now))) return std::nullopt;
    }
    return out;
  }

  // Brings a tile's answers home, from slots to the tile's order.
  TileResult collect(const Study& study, const Window& window, const Slots& slots,
                     const RecordBuffers& sizes, const Buffers& buffers) {
    const std::size_t states = study.model->states.size();
    const std::size_t sampled = study.selection.poincare.size();
    const auto [ends, outputs, numbers] = launcher_.download({{buffers.state, sizes.state},
                                                              {buffers.outputs, sizes.outputs},
                                                              {buffers.series, sizes.series}});
    TileResult result;
    result.final_states = gather_points(ends, slots);
    result.outputs = gather_components(outputs, slots);
    const Array3 series(numbers, sampled, slots.position.size());  // [sample][state][slot]
    result.samples.reserve(slots.slot_of.size() * sampled * window.samples);
    for (const std::size_t slot : slots.slot_of) {
      for (std::size_t i = 0; i < sampled; ++i) {
        for (std::size_t sample = 0; sample < window.samples; ++sample) {
          result.samples.push_back(series[sample][i][slot]);
        }
      }
    }
    result.status.assign(slots.slot_of.size(), STATUS_ok);
    for (std::size_t point = 0; point < result.status.size(); ++point) {
      if (!std::isnan(result.final_states[point * states])) continue;
      result.status[point] = STATUS_diverged;
      blank_point(point, &result);
    }
    return result;
  }

  Launcher launcher_;
  cl::Program program_;
  cl::Kernel settle_, align_, record_, finish_;
  std::unique_ptr<OrbitKernels> orbits_;
  std::size_t series_bytes_per_point_ = 0;
};

}  // namespace

std::unique_ptr<Engine> make_opencl_engine(const Study& study, std::optional<DeviceChoice> choice,
                                           OpenDevices* open) {
  if (!choice) choice = DeviceChoice{default_device(list_devices())};
  const std::shared_ptr<OpenDevice> device = open->open(*choice);
  const std::string& name = device->info().name;
  if (study.integrate.fp64 && !device->info().fp64) {
    throw InputError(
        fmt::format("device {} '{}' has no fp64; use integrate.precision = \"fp32\" "
                    "or another device",
                    choice->number, name));
  }
  try {
    return std::make_unique<OpenClEngine>(study, device);
  } catch (const cl::Error& error) {
    throw RunError(describe_error(fmt::format("preparing device '{}'", name), error));
  }
}

std::unique_ptr<Engine> make_opencl_engine(const Study& study, std::optional<DeviceChoice> choice) {
  OpenDevices open;
  return make_opencl_engine(study, choice, &open);
}

}  // namespace gearsweep
