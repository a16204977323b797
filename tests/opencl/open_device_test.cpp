// Launches of one kernel at once, of any widths, on a device that is opened more than once.
#include "opencl/detail/open_device.hpp"

#include <gtest/gtest.h>

#include <thread>
#include <vector>

#include "opencl/open_devices.hpp"

namespace gearsweep::testing {
namespace {

// Each width is at some moment the widest so far, beside narrower ones. The driver has the kernel
// once, however often its device is opened.
TEST(OpenDevice, RunsLaunchesOfAllWidthsAtOnce) {
  constexpr std::size_t kItems = 3000, kThreads = 4;
  const std::string source =
      "__kernel void count(__global int* counts, int items) {\n"
      "  int i = get_global_id(0);\n"
      "  if (i >= items) return;\n"
      "  for (int turn = 0; turn < 2000; ++turn) counts[i] += (turn ^ i) & 1;\n"
      "}\n";
  std::vector<std::shared_ptr<OpenDevice>> opened;
  for (int i = 0; i < 2; ++i) {
    opened.push_back(OpenDevices().open({.number = default_device(list_devices())}));
  }
  std::vector<int> sums(kThreads);
  const auto work = [&](std::size_t thread) {
    const std::shared_ptr<OpenDevice>& device = opened[thread % opened.size()];
    const cl::Program program = device->program(source, "");
    const cl::CommandQueue queue(device->context(), device->device());
    const cl::Buffer counts(device->context(), CL_MEM_READ_WRITE, kItems * sizeof(cl_int));
    cl::Kernel kernel(program, "count");
    kernel.setArg(0, counts);
    queue.enqueueFillBuffer(counts, cl_int{0}, 0, kItems * sizeof(cl_int));
    for (std::size_t items = 1 + thread; items < kItems; items += items / 3 + thread + 1) {
      kernel.setArg(1, static_cast<cl_int>(items));
      const auto launch = [&](std::size_t width) {
        EXPECT_GE(width, items);
        queue.enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(width), cl::NDRange(4));
        queue.finish();
      };
      const auto load = [](std::size_t) {};
      device->run(kernel, 4, items, load, launch);
      ++sums[thread];
    }
    cl_int first = 0;
    queue.enqueueReadBuffer(counts, CL_TRUE, 0, sizeof first, &first);
    EXPECT_EQ(first, 1000 * sums[thread]);
  };
  {
    std::vector<std::jthread> threads;
    for (std::size_t thread = 0; thread < kThreads; ++thread) threads.emplace_back(work, thread);
  }
}

}  // namespace
}  // namespace gearsweep::testing
