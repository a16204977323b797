// The benchmarks that tell what a device is worth to gearsweep: the same work on every machine.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "opencl/device.hpp"

namespace gearsweep {

// What a benchmark counts.
struct Item {
  std::string name;          // "step"
  std::string unit;          // of a rate: "steps/s"
  double per_iteration = 1;  // so many take what is called the time of an iteration
};

struct Repetition {
  double items = 0.0;
  double seconds = 0.0;       // wall time of these
  double core_seconds = 0.0;  // processor time, of all threads
  // More that it found: "flop/s", "peak_share" of a kernel; "steps/s", "kernel_share" of a map.
  std::map<std::string, double> figures;
};

// One that is ready: kernels are built, what is measured first is warm.
struct PreparedBenchmark {
  std::string build_options;  // of the device compiler; empty: not of one kernel
  std::function<Repetition()> repeat;
};

struct Benchmark {
  std::string name;  // "settle/fp64/lanes:1": what, precision, the rest
  Item item;
  std::string obstacle;  // why the device cannot do it; empty: it can
  // Throws InputError or RunError.
  std::function<PreparedBenchmark()> prepare;
};

struct BenchmarkSetting {
  std::size_t device = 0;  // a number of list_devices()
  double seconds = 0.15;   // that a repetition of a kernel takes, at least
  std::string program;     // the file of gearsweep, whose start is measured
  // Set to stop soon: repetitions then throw RunError, or are worth nothing.
  const std::atomic<bool>* stop = nullptr;  // not null
};

// All of them, in the order of their rows.
std::vector<Benchmark> benchmarks_of(const DeviceInfo& device, const BenchmarkSetting& setting);

// Points per work-item that are worth a look: one, what suits the device, and twice that.
std::set<std::size_t> lanes_to_try(const DeviceInfo& device, bool fp64);

// A benchmark that was carried out.
struct BenchmarkRow {
  std::string name;
  Item item;
  std::string build_options;
  std::string reason;  // why there are no repetitions
  bool failed = false;
  std::vector<Repetition> repetitions;

  // One number of each repetition.
  std::vector<double> rates() const;  // items per second
  std::vector<double> figures(const std::string& figure) const;
};

// At most so many repetitions; none begins once they have taken `max_seconds` in all, or after
// `stop`. A benchmark that fails leaves the reason.
BenchmarkRow carry_out(const Benchmark& benchmark, std::size_t repetitions, double max_seconds,
                       const std::atomic<bool>& stop);

}  // namespace gearsweep
