// The fused multiply-adds that a device can do, measured.
#pragma once

#include <cstddef>
#include <memory>

namespace gearsweep {

class FmaPeak {
 public:
  // `device` is a number of list_devices(). Throws RunError when it cannot run the kernel, as
  // without the precision that is asked for.
  FmaPeak(std::size_t device, bool fp64);
  ~FmaPeak();
  FmaPeak(const FmaPeak&) = delete;
  FmaPeak& operator=(const FmaPeak&) = delete;

  struct Launch {
    double flops = 0.0, seconds = 0.0;
    double rate() const { return flops / seconds; }
  };
  // Runs all compute units for some 25 ms; a multiply-add is two operations. Throws RunError.
  Launch launch();

 private:
  class Kernel;
  std::unique_ptr<Kernel> kernel_;
};

}  // namespace gearsweep
