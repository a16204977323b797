// A device at work for one study: its queue, its buffers, and what each kernel is given of a tile.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "engine/engine.hpp"
#include "model/error.hpp"
#include "opencl/detail/cl.hpp"
#include "opencl/detail/open_device.hpp"
#include "opencl/detail/tile_buffers.hpp"
#include "opencl/device.hpp"

namespace gearsweep {

// A tile on the device: the arguments that every kernel takes after its round.
struct TileInputs {
  Slots slots;
  std::vector<cl::Buffer> arguments;
  double steps_per_period = 0.0;  // of all points together
};

class Launcher {
 public:
  Launcher(const Study& study, std::shared_ptr<OpenDevice> open);

  const DeviceInfo& device() const { return open_->info(); }
  std::size_t lanes() const { return lanes_; }
  std::size_t local_size() const { return local_size_; }
  const std::string& build_options() const { return options_; }
  std::size_t scalar_bytes() const { return fp64_ ? sizeof(double) : sizeof(float); }

  // The program of `file` in kernels/, for this study. Throws RunError.
  cl::Program program(const Study& study, const std::string& file);

  // Calls work() and returns its answer; a failure of the device becomes a RunError that names the
  // tile.
  template <class Work>
  auto guard(const Tile& tile, const Work& work) const {
    try {
      return work();
    } catch (const cl::Error& error) {
      throw RunError(failure(tile, error));
    }
  }

  // Numbers of the study's precision, from and to double.
  cl::Buffer upload(const std::vector<double>& numbers, cl_mem_flags flags);
  cl::Buffer upload(const std::vector<std::uint32_t>& numbers);
  cl::Buffer allocate(std::size_t numbers);
  // So many numbers of a buffer, from its beginning.
  struct Stretch {
    cl::Buffer buffer;
    std::size_t numbers;
  };
  // Waits once for all of them: on a CPU, a copy waits for the launches of other engines.
  template <std::size_t count>
  std::array<std::vector<double>, count> download(const Stretch (&stretches)[count]) {
    if (fp64_) return copies<double>(stretches);
    const std::array<std::vector<float>, count> rounded = copies<float>(stretches);
    std::array<std::vector<double>, count> numbers;
    for (std::size_t i = 0; i < count; ++i) numbers[i].assign(rounded[i].begin(), rounded[i].end());
    return numbers;
  }
  // The buffer's numbers as the device has them, not copied where it shares the host's memory. No
  // kernel may write the buffer while they are held.
  std::shared_ptr<const void> view(const cl::Buffer& buffer, std::size_t numbers);

  TileInputs prepare(const Plan& plan, const Tile& tile);
  // Gives a kernel all its arguments but the first, which is the round of each launch: those that a
  // tile has in common, then buffers, integers and numbers of the study's precision.
  template <class... Arguments>
  void bind(cl::Kernel* kernel, const TileInputs& inputs, const Arguments&... arguments) const {
    cl_uint number = 1;
    for (const cl::Buffer& input : inputs.arguments) kernel->setArg(number++, input);
    (set_argument(kernel, number++, arguments), ...);
  }
  template <class... Arguments>
  void bind(cl::Kernel* kernel, const Arguments&... arguments) const {
    cl_uint number = 1;
    (set_argument(kernel, number++, arguments), ...);
  }

  // Returns when the kernel has ended: the seconds that it took.
  double launch(cl::Kernel* kernel, const SweepRound& round);
  const BusyClock& clock() const { return open_->clock(); }
  // Advances a tile by `periods`, round by round; false when the callback asked to stop.
  bool run_rounds(cl::Kernel* kernel, const Window& window, const TileInputs& inputs,
                  std::size_t periods, const RoundCallback& after_round);

 private:
  // The phase grids that were uploaded last. A tile all of whose grids are among them, as a
  // subset's are, uploads none.
  struct GridBank {
    std::map<std::vector<double>, std::uint32_t> index;  // by Plan::grid_key()
    std::vector<std::size_t> steps;                      // of a period
    std::vector<double> coefs;  // where the device reads them in place: they outlive its buffer
    std::vector<cl::Buffer> tables;
  };
  static void set_argument(cl::Kernel* kernel, cl_uint number, const cl::Buffer& buffer) {
    kernel->setArg(number, buffer);
  }
  static void set_argument(cl::Kernel* kernel, cl_uint number, cl_uint value) {
    kernel->setArg(number, value);
  }
  void set_argument(cl::Kernel* kernel, cl_uint number, double value) const;
  std::string failure(const Tile& tile, const cl::Error& error) const;
  // The index of each of the tile's grids in the bank.
  std::vector<std::uint32_t> find_grids(const Plan& plan, const Tile& tile);
  void fill_bank(const Plan& plan, const Tile& tile);
  template <class Scalar, std::size_t count>
  std::array<std::vector<Scalar>, count> copies(const Stretch (&stretches)[count]) {
    // Until the queue is done it writes to them, also where it took only some of the copies.
    struct Done {
      ~Done() { clFinish(queue()); }
      const cl::CommandQueue& queue;
    };
    std::array<std::vector<Scalar>, count> out;
    const Done done{queue_};
    for (std::size_t i = 0; i < count; ++i) {
      out[i].resize(stretches[i].numbers);
      if (out[i].empty()) continue;
      queue_.enqueueReadBuffer(stretches[i].buffer, CL_FALSE, 0, out[i].size() * sizeof(Scalar),
                               out[i].data());
    }
    queue_.finish();
    return out;
  }
  // The buffer's bytes in the host's memory, for as long as they are held.
  std::shared_ptr<void> map(const cl::Buffer& buffer, std::size_t bytes, cl_map_flags flags);
  cl::Buffer upload_bytes(const void* bytes, std::size_t count, cl_mem_flags flags);

  const std::shared_ptr<OpenDevice> open_;
  const bool fp64_;
  const std::size_t fixed_round_;
  std::size_t lanes_, local_size_;
  std::string options_;
  cl::CommandQueue queue_;
  GridBank bank_;
  std::shared_ptr<void> pinned_;  // host memory that views are copied into
  std::size_t pinned_bytes_ = 0;
  double steps_per_second_ = 0.0;  // of the last round; 0: not known yet
};

// A launch that advances by `periods`, of which `done` of the same kind lie behind it.
SweepRound round_of(const Window& window, std::size_t items, std::size_t periods, std::size_t done);

}  // namespace gearsweep
