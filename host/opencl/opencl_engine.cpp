#include "opencl/opencl_engine.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "model/error.hpp"
#include "opencl/cl.hpp"
#include "opencl/device.hpp"
#include "opencl/program.hpp"
#include "opencl/program_cache.hpp"
#include "opencl/tile_buffers.hpp"

namespace gearsweep {
namespace {

constexpr double kRoundSeconds = 0.3;  // short enough to cancel and for a display's watchdog
constexpr std::size_t kMostSeriesBytes = std::size_t{256} << 20U;  // of a tile's samples

// A launch that advances by `periods`, of which `done` of the same kind lie behind it.
SweepRound round_of(const Window& window, std::size_t items, std::size_t periods,
                    std::size_t done) {
  const auto number = [](std::size_t count) { return static_cast<sweep_uint>(count); };
  return {number(items),           number(periods),        number(done),
          number(window.record),   number(window.samples), number(window.before + window.settle),
          window.is_last ? 1U : 0U};
}

// The number of periods of the next launch, from how long the last one took.
std::size_t next_round(std::size_t last, double seconds) {
  const double factor = std::clamp(kRoundSeconds / std::max(seconds, 1e-6), 0.1, 8.0);
  return std::max<std::size_t>(1, static_cast<std::size_t>(static_cast<double>(last) * factor));
}

class OpenClEngine final : public Engine {
 public:
  OpenClEngine(const Study& study, const cl::Device& device, const DeviceInfo& info)
      : fp64_(study.integrate.fp64), info_(info), context_(device), queue_(context_, device) {
    lanes_ = study.integrate.lanes;
    if (lanes_ == 0) lanes_ = fp64_ ? info.lanes_fp64 : info.lanes_fp32;
    local_size_ = study.integrate.local_size;
    if (local_size_ == 0) local_size_ = info.is_cpu ? 4 : 64;
    options_ = build_options(study, lanes_);
    program_ = cached_program(context_, device, program_source(study), options_,
                              program_cache_folder(info.platform));
    settle_ = cl::Kernel(program_, "settle");
    record_ = cl::Kernel(program_, "record");
    if (study.selection.tangent_count() > 0) align_ = cl::Kernel(program_, "align");
    finish_ = cl::Kernel(program_, "finish");
    series_bytes_per_point_ =
        study.selection.poincare.size() * study.integrate.record * scalar_bytes();
  }

  EngineInfo info() const override {
    return {fmt::format("{} ({})", info_.name, info_.platform), info_.driver, options_};
  }

  std::size_t least_tile() const override {
    return std::min(preferred_tile(),
                    info_.is_cpu ? 4 * info_.compute_units * local_size_ * lanes_ : 16384);
  }

  std::size_t preferred_tile() const override {
    const std::size_t points = info_.is_cpu ? 4096 : 131072;
    if (series_bytes_per_point_ == 0) return points;
    return std::clamp(kMostSeriesBytes / series_bytes_per_point_, std::size_t{64}, points);
  }

  std::optional<TileResult> compute(const Plan& plan, const Tile& tile,
                                    const std::vector<double>& initial, const Window& window,
                                    const RoundCallback& after_round) override {
    try {
      return compute_tile(plan, tile, initial, window, after_round);
    } catch (const cl::Error& error) {
      throw RunError(fmt::format("{}\n(a smaller integrate.tile needs less memory)",
                                 describe_error(fmt::format("computing a tile of {} points on '{}'",
                                                            tile.points.size(), info_.name),
                                                error)));
    }
  }

 private:
  // The device's side of one tile.
  struct Buffers {
    cl::Buffer state, tangents, accumulators, series, outputs;
  };

  std::size_t scalar_bytes() const { return fp64_ ? sizeof(double) : sizeof(float); }

  template <class T>
  cl::Buffer upload(const std::vector<T>& values, cl_mem_flags flags) {
    // A buffer cannot be empty; one that is never read may hold anything.
    if (values.empty()) return cl::Buffer(context_, CL_MEM_READ_WRITE, 64);
    // OpenCL takes the source of a copy without const, and does not write to it.
    return cl::Buffer(context_, flags | CL_MEM_COPY_HOST_PTR, values.size() * sizeof(T),
                      const_cast<T*>(values.data()));
  }

  cl::Buffer allocate(std::size_t numbers) {
    return cl::Buffer(context_, CL_MEM_READ_WRITE,
                      std::max<std::size_t>(64, numbers * scalar_bytes()));
  }

  std::vector<double> download(const cl::Buffer& buffer, std::size_t numbers) {
    std::vector<std::byte> bytes(numbers * scalar_bytes());
    if (numbers > 0) queue_.enqueueReadBuffer(buffer, CL_TRUE, 0, bytes.size(), bytes.data());
    return unpack(bytes, fp64_);
  }

  void launch(cl::Kernel& kernel, std::size_t items) {
    // On a CPU, few items spread over all cores rather than fill the work-groups of one. No other
    // sizes between: a driver may compile a kernel anew for each.
    const bool are_few = info_.is_cpu && items < info_.compute_units * local_size_;
    const std::size_t local = are_few ? 1 : local_size_;
    const std::size_t global = (items + local - 1) / local * local;
    queue_.enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(global), cl::NDRange(local));
    queue_.finish();
  }

  // Advances a tile by `periods`, round by round; false when the callback asked to stop.
  bool run_rounds(cl::Kernel& kernel, const Window& window, std::size_t fixed_length,
                  std::size_t items, std::size_t periods, double steps_per_period,
                  const RoundCallback& after_round) {
    std::size_t length = fixed_length > 0 ? fixed_length : 4;
    for (std::size_t done = 0; done < periods;) {
      const std::size_t now = std::min(length, periods - done);
      kernel.setArg(0, round_of(window, items, now, done));
      const auto start = std::chrono::steady_clock::now();
      launch(kernel, items);
      const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
      done += now;
      if (fixed_length == 0) length = next_round(now, took.count());
      if (!after_round(steps_per_period * static_cast<double>(now))) return false;
    }
    return true;
  }

  std::optional<TileResult> compute_tile(const Plan& plan, const Tile& tile,
                                         const std::vector<double>& initial, const Window& window,
                                         const RoundCallback& after_round) {
    const Study& study = plan.study();
    const Slots slots = arrange_slots(tile, lanes_);
    const std::size_t slot_count = slots.position.size();
    const std::size_t state_count = study.model->states.size();
    const GridTables tables = make_grid_tables(plan, tile);
    double steps_per_period = 0.0;
    for (const std::size_t slot : slots.slot_of) {
      steps_per_period += static_cast<double>(tables.steps[slots.item_grid[slot / lanes_]]);
    }

    const std::vector<cl::Buffer> inputs = {
        upload(pack(study.setting.parameters, fp64_), CL_MEM_READ_ONLY),
        upload(pack(swept_values(plan, tile, slots), fp64_), CL_MEM_READ_ONLY),
        upload(slots.item_grid, CL_MEM_READ_ONLY),
        upload(tables.grids, CL_MEM_READ_ONLY),
        upload(tables.segment_steps, CL_MEM_READ_ONLY),
        upload(pack(tables.segment_fractions, fp64_), CL_MEM_READ_ONLY),
        upload(pack(tables.coefs, fp64_), CL_MEM_READ_ONLY)};
    Buffers buffers;
    buffers.state =
        upload(pack(spread_states(initial, state_count, slots), fp64_), CL_MEM_READ_WRITE);
    buffers.tangents = upload(pack(first_tangents(study, slot_count), fp64_), CL_MEM_READ_WRITE);
    buffers.accumulators = allocate(study.selection.accumulator_count() * slot_count);
    buffers.outputs = allocate(study.selection.output_count() * slot_count);
    buffers.series = allocate(study.selection.poincare.size() * window.samples * slot_count);
    const bool with_tangents = study.selection.tangent_count() > 0;
    for (cl::Kernel* kernel : {&settle_, &align_, &record_}) {
      if (kernel == &align_ && !with_tangents) continue;
      cl_uint argument = 1;
      for (const cl::Buffer& input : inputs) kernel->setArg(argument++, input);
      kernel->setArg(argument++, buffers.state);
      if (kernel == &settle_) continue;
      kernel->setArg(argument++, buffers.tangents);
      if (kernel == &align_) continue;
      kernel->setArg(argument++, buffers.accumulators);
      kernel->setArg(argument++, buffers.series);
    }

    const std::size_t aligned =
        with_tangents ? std::min(study.integrate.warm_up, window.settle) : 0;
    const auto advance = [&](cl::Kernel& kernel, std::size_t periods) {
      return run_rounds(kernel, window, study.integrate.round, slots.items(), periods,
                        steps_per_period, after_round);
    };
    if (!advance(settle_, window.settle - aligned) || !advance(align_, aligned) ||
        !advance(record_, window.record)) {
      return std::nullopt;
    }
    finish_.setArg(0, round_of(window, slots.items(), 0, window.record));
    finish_.setArg(1, buffers.accumulators);
    finish_.setArg(2, buffers.outputs);
    launch(finish_, slots.items());
    return collect(study, window, slots, buffers);
  }

  // Brings a tile's answers home, from slots to the tile's order.
  TileResult collect(const Study& study, const Window& window, const Slots& slots,
                     const Buffers& buffers) {
    const std::size_t points = slots.slot_of.size();
    const std::size_t slot_count = slots.position.size();
    const std::size_t states = study.model->states.size();
    const std::size_t outputs = study.selection.output_count();
    const std::size_t sampled = study.selection.poincare.size();
    const std::size_t samples = window.samples;
    const std::vector<double> state = download(buffers.state, states * slot_count);
    const std::vector<double> values = download(buffers.outputs, outputs * slot_count);
    const std::vector<double> series = download(buffers.series, sampled * samples * slot_count);
    const double nan = std::numeric_limits<double>::quiet_NaN();

    TileResult result;
    result.outputs.resize(outputs * points);
    result.samples.resize(points * sampled * samples);
    result.final_states.resize(points * states);
    for (std::size_t point = 0; point < points; ++point) {
      const std::size_t slot = slots.slot_of[point];
      const bool diverged = std::isnan(state[slot]);
      result.status.push_back(diverged ? STATUS_diverged : STATUS_ok);
      for (std::size_t i = 0; i < states; ++i) {
        result.final_states[point * states + i] = state[i * slot_count + slot];
      }
      for (std::size_t i = 0; i < outputs; ++i) {
        result.outputs[i * points + point] = diverged ? nan : values[i * slot_count + slot];
      }
      for (std::size_t i = 0; i < sampled * samples; ++i) {
        const double value = series[(i % samples * sampled + i / samples) * slot_count + slot];
        result.samples[point * sampled * samples + i] = diverged ? nan : value;
      }
    }
    return result;
  }

  const bool fp64_;
  const DeviceInfo info_;
  std::size_t lanes_ = 1;
  std::size_t local_size_ = 1;
  std::size_t series_bytes_per_point_ = 0;
  std::string options_;
  cl::Context context_;
  cl::CommandQueue queue_;
  cl::Program program_;
  cl::Kernel settle_, align_, record_, finish_;
};

}  // namespace

std::unique_ptr<Engine> make_opencl_engine(const Study& study, std::optional<std::size_t> device) {
  const std::vector<DeviceInfo> infos = list_devices();
  const std::size_t number = device.value_or(infos.empty() ? 0 : default_device(infos));
  if (infos.empty()) default_device(infos);
  if (number >= infos.size()) {
    throw InputError(
        fmt::format("there is no device {}; 'gearsweep devices' lists {} (numbered "
                    "from 0)",
                    number, infos.size()));
  }
  if (study.integrate.fp64 && !infos[number].fp64) {
    throw InputError(
        fmt::format("device {} '{}' has no fp64; use integrate.precision = \"fp32\" "
                    "or another device",
                    number, infos[number].name));
  }
  try {
    return std::make_unique<OpenClEngine>(study, find_devices()[number], infos[number]);
  } catch (const cl::Error& error) {
    throw RunError(describe_error(fmt::format("preparing device '{}'", infos[number].name), error));
  }
}

}  // namespace gearsweep
