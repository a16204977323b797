#include "opencl/fma_peak.hpp"

#include <fmt/format.h>

#include <chrono>
#include <string>

#include "model/error.hpp"
#include "opencl/detail/cl.hpp"
#include "opencl/detail/program.hpp"
#include "opencl/device.hpp"

namespace gearsweep {
namespace {

// Independent chains per work-item: two units of latency 4 or 5 need 8 to 10 of them, and 12 still
// fit 16 registers. Every chain tends to add / (1 - factor), so no number overflows.
constexpr std::size_t kChains = 12;
constexpr const char* kSource = R"(
__kernel void fma_chains(__global real* out, const scalar factor, const scalar add,
                         const uint turns) {
  real chain[CHAINS];
  _Pragma("unroll")
  for (int i = 0; i < CHAINS; ++i) chain[i] = (real)((scalar)(get_global_id(0) * CHAINS + i));
  const real factors = factor;
  const real adds = add;
  for (uint turn = 0; turn < turns; ++turn) {
    _Pragma("unroll")
    for (int i = 0; i < CHAINS; ++i) chain[i] = fma(chain[i], factors, adds);
  }
  real sum = 0;
  _Pragma("unroll")
  for (int i = 0; i < CHAINS; ++i) sum += chain[i];
  out[get_global_id(0)] = sum;
}
)";

constexpr double kLaunchSeconds = 0.025;

}  // namespace

class FmaPeak::Kernel {
 public:
  Kernel(const cl::Device& device, const DeviceInfo& info, bool fp64)
      : context_(device), queue_(context_, device) {
    lanes_ = fp64 ? info.lanes_fp64 : info.lanes_fp32;
    local_size_ = info.is_cpu ? 4 : 64;
    items_ = info.compute_units * local_size_ * (info.is_cpu ? 8 : 32);
    const std::string type = fp64 ? "double" : "float";
    const std::string options =
        fmt::format("-cl-std=CL1.2 -DCHAINS={} -Dscalar={} -Dreal={}{}", kChains, type, type,
                    lanes_ > 1 ? std::to_string(lanes_) : "");
    kernel_ = cl::Kernel(build_program(context_, device, kSource, options), "fma_chains");
    const std::size_t scalar_bytes = fp64 ? sizeof(double) : sizeof(float);
    out_ = cl::Buffer(context_, CL_MEM_READ_WRITE, items_ * lanes_ * scalar_bytes);
    kernel_.setArg(0, out_);
    if (fp64) {
      kernel_.setArg(1, 0.999);
      kernel_.setArg(2, 0.001);
    } else {
      kernel_.setArg(1, 0.999F);
      kernel_.setArg(2, 0.001F);
    }
    run();  // the first launch finishes the build
    while (run() < kLaunchSeconds) turns_ *= 2;
  }

  Launch launch() {
    const double turns = turns_;
    return {2.0 * turns * static_cast<double>(kChains * lanes_ * items_), run()};
  }

 private:
  // The seconds of a launch.
  double run() {
    kernel_.setArg(3, turns_);
    const auto start = std::chrono::steady_clock::now();
    queue_.enqueueNDRangeKernel(kernel_, cl::NullRange, cl::NDRange(items_),
                                cl::NDRange(local_size_));
    queue_.finish();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }

  cl::Context context_;
  cl::CommandQueue queue_;
  cl::Kernel kernel_;
  cl::Buffer out_;
  std::size_t local_size_ = 1, items_ = 1, lanes_ = 1;
  cl_uint turns_ = 1000;
};

FmaPeak::FmaPeak(std::size_t device, bool fp64) {
  try {
    kernel_ = std::make_unique<Kernel>(find_devices().at(device), list_devices().at(device), fp64);
  } catch (const cl::Error& error) {
    throw RunError(describe_error("measuring fused multiply-adds", error));
  }
}

FmaPeak::~FmaPeak() = default;

FmaPeak::Launch FmaPeak::launch() {
  try {
    return kernel_->launch();
  } catch (const cl::Error& error) {
    throw RunError(describe_error("measuring fused multiply-adds", error));
  }
}

}  // namespace gearsweep
