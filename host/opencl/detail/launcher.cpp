#include "opencl/detail/launcher.hpp"

#include <fmt/format.h>

#include "opencl/detail/program.hpp"

namespace gearsweep {
namespace {

constexpr double kRoundSeconds = 0.3;  // short enough to cancel and for a display's watchdog

}  // namespace

SweepRound round_of(const Window& window, std::size_t items, std::size_t periods,
                    std::size_t done) {
  const auto number = [](std::size_t count) { return static_cast<sweep_uint>(count); };
  return {number(items),
          number(periods),
          number(done),
          number(window.record),
          number(window.samples),
          number(window.before + window.settle),
          window.is_last ? 1U : 0U,
          window.is_early ? 1U : 0U};
}

Launcher::Launcher(const Study& study, std::shared_ptr<OpenDevice> open)
    : open_(std::move(open)),
      fp64_(study.integrate.fp64),
      fixed_round_(study.integrate.round),
      lanes_(study.integrate.lanes),
      local_size_(study.integrate.local_size),
      queue_(open_->context(), open_->device()) {
  const DeviceInfo& info = device();
  if (lanes_ == 0) lanes_ = fp64_ ? info.lanes_fp64 : info.lanes_fp32;
  if (local_size_ == 0) local_size_ = info.is_cpu ? 4 : 64;
  options_ = gearsweep::build_options(study, lanes_, info.rounds_fp32_division);
}

cl::Program Launcher::program(const Study& study, const std::string& file) {
  return open_->program(program_source(study, file), options_);
}

std::string Launcher::failure(const Tile& tile, const cl::Error& error) const {
  const std::string doing =
      fmt::format("computing a tile of {} points on '{}'", tile.points.size(), device().name);
  return fmt::format("{}\n(a smaller integrate.tile needs less memory)",
                     describe_error(doing, error));
}

cl::Buffer Launcher::upload_bytes(const void* bytes, std::size_t count, cl_mem_flags flags) {
  // A buffer cannot be empty; one that is never read may hold anything.
  if (count == 0) return cl::Buffer(open_->context(), CL_MEM_READ_WRITE, 64);
  // OpenCL takes the source of a copy without const, and does not write to it.
  return cl::Buffer(open_->context(), flags | CL_MEM_COPY_HOST_PTR, count,
                    const_cast<void*>(bytes));
}

cl::Buffer Launcher::upload(const std::vector<double>& numbers, cl_mem_flags flags) {
  if (fp64_) return upload_bytes(numbers.data(), numbers.size() * sizeof(double), flags);
  const std::vector<float> rounded(numbers.begin(), numbers.end());
  return upload_bytes(rounded.data(), rounded.size() * sizeof(float), flags);
}

cl::Buffer Launcher::upload(const std::vector<std::uint32_t>& numbers) {
  return upload_bytes(numbers.data(), numbers.size() * sizeof(std::uint32_t), CL_MEM_READ_ONLY);
}

cl::Buffer Launcher::allocate(std::size_t numbers) {
  return cl::Buffer(open_->context(), CL_MEM_READ_WRITE,
                    std::max<std::size_t>(64, numbers * scalar_bytes()));
}

std::shared_ptr<const void> Launcher::view(const cl::Buffer& buffer, std::size_t numbers) {
  const std::size_t bytes = numbers * scalar_bytes();
  if (device().shares_host_memory) return map(buffer, bytes, CL_MAP_READ);
  // Pinned memory, which the device writes fast, is kept for the next view.
  if (pinned_bytes_ < bytes || pinned_.use_count() > 1) {
    const cl::Buffer buffer_of_host(open_->context(), CL_MEM_READ_WRITE | CL_MEM_ALLOC_HOST_PTR,
                                    bytes);
    pinned_ = map(buffer_of_host, bytes, CL_MAP_READ | CL_MAP_WRITE);
    pinned_bytes_ = bytes;
  }
  queue_.enqueueReadBuffer(buffer, CL_TRUE, 0, bytes, pinned_.get());
  return pinned_;
}

std::shared_ptr<void> Launcher::map(const cl::Buffer& buffer, std::size_t bytes,
                                    cl_map_flags flags) {
  void* mapped = queue_.enqueueMapBuffer(buffer, CL_TRUE, flags, 0, bytes);
  const auto unmap = [buffer, queue = queue_](void* held) {
    // The release of the buffer ends the mapping where this fails.
    clEnqueueUnmapMemObject(queue(), buffer(), held, 0, nullptr, nullptr);
    clFinish(queue());
  };
  return {mapped, unmap};
}

void Launcher::set_argument(cl::Kernel* kernel, cl_uint number, double value) const {
  if (fp64_) {
    kernel->setArg(number, value);
  } else {
    kernel->setArg(number, static_cast<float>(value));
  }
}

void Launcher::fill_bank(const Plan& plan, const Tile& tile) {
  bank_.tables.clear();  // before what they may read in place
  bank_ = {};
  std::vector<std::size_t> points;  // one of each grid
  for (const std::size_t start : tile.grid_starts) {
    const auto number = static_cast<std::uint32_t>(bank_.index.size());
    const std::size_t point = tile.points[start];
    if (bank_.index.emplace(plan.grid_key(point), number).second) points.push_back(point);
  }
  GridTables tables = make_grid_tables(plan, points);
  bank_.steps = std::move(tables.steps);
  bank_.tables = {
      upload_bytes(tables.grids.data(), tables.grids.size() * sizeof(SweepGrid), CL_MEM_READ_ONLY),
      upload(tables.segment_steps), upload(tables.segment_fractions, CL_MEM_READ_ONLY)};
  const bool is_read_in_place = fp64_ && device().shares_host_memory && !tables.coefs.empty();
  if (is_read_in_place) {
    bank_.coefs = std::move(tables.coefs);
    bank_.tables.emplace_back(open_->context(), CL_MEM_READ_ONLY | CL_MEM_USE_HOST_PTR,
                              bank_.coefs.size() * sizeof(double), bank_.coefs.data());
  } else {
    bank_.tables.push_back(upload(tables.coefs, CL_MEM_READ_ONLY));
  }
}

std::vector<std::uint32_t> Launcher::find_grids(const Plan& plan, const Tile& tile) {
  std::vector<std::vector<double>> keys;
  for (const std::size_t start : tile.grid_starts) {
    keys.push_back(plan.grid_key(tile.points[start]));
  }
  const bool has_all = std::all_of(keys.begin(), keys.end(), [&](const std::vector<double>& key) {
    return bank_.index.count(key) > 0;
  });
  if (!has_all) fill_bank(plan, tile);
  std::vector<std::uint32_t> numbers;
  for (const std::vector<double>& key : keys) numbers.push_back(bank_.index.at(key));
  return numbers;
}

TileInputs Launcher::prepare(const Plan& plan, const Tile& tile) {
  const std::vector<std::uint32_t> grids = find_grids(plan, tile);
  TileInputs inputs;
  inputs.slots = arrange_slots(tile, lanes_);
  std::vector<std::uint32_t> item_grid;
  for (const std::uint32_t group : inputs.slots.item_group) item_grid.push_back(grids[group]);
  for (const std::size_t slot : inputs.slots.slot_of) {
    inputs.steps_per_period += static_cast<double>(bank_.steps[item_grid[slot / lanes_]]);
  }
  std::vector<double> uniform = plan.study().setting.parameters;
  uniform.push_back(plan.study().model->binding.clock);
  inputs.arguments = {
      upload(uniform, CL_MEM_READ_ONLY),
      upload(swept_rows(plan)),
      upload(swept_values(plan, tile, inputs.slots), CL_MEM_READ_ONLY),
      upload(item_grid),
  };
  inputs.arguments.insert(inputs.arguments.end(), bank_.tables.begin(), bank_.tables.end());
  return inputs;
}

double Launcher::launch(cl::Kernel* kernel, const SweepRound& round) {
  const std::size_t items = round.items;
  kernel->setArg(0, round);
  // On a CPU, few items spread evenly over all cores rather than fill work-groups. No other sizes
  // between: a driver may compile a kernel anew for each.
  constexpr std::size_t kGroupsPerCore = 8;
  const bool are_few =
      device().is_cpu && items < kGroupsPerCore * device().compute_units * local_size_;
  const std::size_t local = are_few ? 1 : local_size_;
  const auto enqueue = [&](std::size_t width) {
    queue_.enqueueNDRangeKernel(*kernel, cl::NullRange, cl::NDRange(width), cl::NDRange(local));
    queue_.finish();
  };
  const auto load = [&](std::size_t width) {
    SweepRound nothing = round;
    nothing.items = 0;
    kernel->setArg(0, nothing);
    enqueue(width);
    kernel->setArg(0, round);
  };
  double seconds = 0.0;
  open_->run(*kernel, local, items, load,
             [&](std::size_t width) { seconds = open_->clock().time([&] { enqueue(width); }); });
  return seconds;
}

bool Launcher::run_rounds(cl::Kernel* kernel, const Window& window, const TileInputs& inputs,
                          std::size_t periods, const RoundCallback& after_round) {
  constexpr double kFirstRound = 4.0;  // periods, while the device's speed is not known
  for (std::size_t done = 0; done < periods;) {
    const double fitting = steps_per_second_ > 0.0
                               ? kRoundSeconds * steps_per_second_ / inputs.steps_per_period
                               : kFirstRound;
    const std::size_t length =
        fixed_round_ > 0 ? fixed_round_ : static_cast<std::size_t>(std::clamp(fitting, 1.0, 1e6));
    const std::size_t now = std::min(length, periods - done);
    const double seconds = launch(kernel, round_of(window, inputs.slots.items(), now, done));
    const double steps = inputs.steps_per_period * static_cast<double>(now);
    steps_per_second_ = steps / std::max(seconds, 1e-6);
    done += now;
    if (!after_round(steps)) return false;
  }
  return true;
}

}  // namespace gearsweep
