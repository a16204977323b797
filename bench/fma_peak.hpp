// The fused multiply-adds per second that a device can do, measured.
#pragma once

#include <cstddef>

#include "opencl/detail/cl.hpp"

namespace gearsweep::bench {

class FmaPeak {
 public:
  // `device` is a number of list_devices().
  FmaPeak(std::size_t device, bool fp64);

  // Runs all compute units for some 25 ms; a multiply-add is two operations.
  double flops_per_second();

 private:
  double run();

  cl::Context context_;
  cl::CommandQueue queue_;
  cl::Kernel kernel_;
  cl::Buffer out_;
  std::size_t local_size_ = 1, items_ = 1, lanes_ = 1;
  cl_uint turns_ = 1000;
};

}  // namespace gearsweep::bench
