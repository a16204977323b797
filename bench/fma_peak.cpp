#include "fma_peak.hpp"

#include <fmt/format.h>

#include <chrono>

#include "opencl/device.hpp"

namespace gearsweep::bench {
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

constexpr double kSliceSeconds = 0.025;

}  // namespace

FmaPeak::FmaPeak(std::size_t device, bool fp64)
    : context_(find_devices().at(device)), queue_(context_, find_devices().at(device)) {
  const DeviceInfo info = list_devices().at(device);
  lanes_ = fp64 ? info.lanes_fp64 : info.lanes_fp32;
  local_size_ = info.is_cpu ? 4 : 64;
  items_ = info.compute_units * local_size_ * (info.is_cpu ? 8 : 32);
  const std::string type = fp64 ? "double" : "float";
  const std::string options =
      fmt::format("-cl-std=CL1.2 -DCHAINS={} -Dscalar={} -Dreal={}{}", kChains, type, type,
                  lanes_ > 1 ? std::to_string(lanes_) : "");
  cl::Program program(context_, kSource);
  program.build({find_devices().at(device)}, options.c_str());
  kernel_ = cl::Kernel(program, "fma_chains");
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
  while (run() < kSliceSeconds) turns_ *= 2;
}

double FmaPeak::run() {
  kernel_.setArg(3, turns_);
  const auto start = std::chrono::steady_clock::now();
  queue_.enqueueNDRangeKernel(kernel_, cl::NullRange, cl::NDRange(items_),
                              cl::NDRange(local_size_));
  queue_.finish();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double FmaPeak::flops_per_second() {
  const double seconds = run();
  return 2.0 * static_cast<double>(turns_) * static_cast<double>(kChains * lanes_ * items_) /
         seconds;
}

}  // namespace gearsweep::bench
