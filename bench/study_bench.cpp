// Whole studies, from the start of the program to the closed result file, as a user runs them; the
// kernels have been built before, and the platform or gearsweep has kept them.
//
//   study/...    points per second of built-in studies
//   points/N     how time and memory grow with the number of points
//   cores/N      ... with the number of cores (PoCL), measured in turn with one core
//   devices/N    ... each device, when there are several
//   stopping/... a map of which most points are periodic, in turn with the same one to the end
//   memory/...   bytes that a point more takes: in the map, or in a tile, where the device's
//   buffers
//                and their packing on the host are (of a device without memory of its own)
//
//   wall_s           from start to end
//   computing_share  of it, in tiles: launches, transfers, packing
//   busy_share       of it, all cores of the machine
//   vs_never         how many times as long the run to the end takes
//   peak_bytes       largest resident memory of the process
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "benchmarks.hpp"
#include "figures.hpp"
#include "measure/program_run.hpp"
#include "opencl/device.hpp"

namespace gearsweep::bench {
namespace {

constexpr const char* kMap = "coarse-map";
const std::vector<std::string> kUsual = {"integrate.settle=40", "integrate.record=20"};
// Little work for each point, so that what the host does for it shows.
const std::vector<std::string> kBrief = {"integrate.settle=10", "integrate.record=5",
                                         "integrate.steps_per_period=64"};
// Next to none.
const std::vector<std::string> kFewest = {"integrate.settle=1", "integrate.record=1",
                                          "integrate.steps_per_period=16"};

std::vector<std::string> with_counts(std::vector<std::string> overrides, std::size_t x,
                                     std::size_t y) {
  overrides.push_back(fmt::format("axes.omega.count={}", x));
  overrides.push_back(fmt::format("axes.e0.count={}", y));
  return overrides;
}

ProgramCost run(const ProgramCall& call) { return run_program(GEARSWEEP_BINARY, call); }

// How many the machine has.
unsigned cores() { return std::max(1U, std::thread::hardware_concurrency()); }

void add_figures(const ProgramCost& cost, Figures* figures) {
  figures->add("wall_s", cost.wall_seconds);
  figures->add("points/s", cost.points / cost.wall_seconds);
  figures->add("steps/s", cost.steps / cost.wall_seconds);
  figures->add("computing_share", cost.computing_seconds / cost.wall_seconds);
  figures->add("busy_share", cost.core_seconds / cost.wall_seconds / cores());
  figures->add("peak_bytes", cost.peak_bytes);
}

// measure: one iteration; adds its figures and gives the seconds to report. A run of `first` with
// next to no work comes first, so that the kernels have been built.
void add(const std::string& name, int turns, const ProgramCall& first,
         const std::function<double(Figures*)>& measure) {
  const auto body = [=](benchmark::State& state) {
    try {
      ProgramCall brief = first;
      brief.overrides.insert(brief.overrides.end(), kFewest.begin(), kFewest.end());
      run(brief);
      Figures figures;
      for ([[maybe_unused]] auto turn : state) state.SetIterationTime(measure(&figures));
      figures.report(state);
    } catch (const std::exception& error) {
      state.SkipWithError(error.what());
    }
  };
  benchmark::internal::Benchmark* added = benchmark::RegisterBenchmark(name.c_str(), body);
  added->UseManualTime()->Unit(benchmark::kMillisecond)->Iterations(turns);
}

void add_study(const std::string& name, int turns, const ProgramCall& first,
               const ProgramCall& command) {
  add(name, turns, first, [command](Figures* figures) {
    const ProgramCost cost = run(command);
    add_figures(cost, figures);
    return cost.wall_seconds;
  });
}

void add_study(const std::string& name, int turns, const ProgramCall& command) {
  add_study(name, turns, command, command);
}

void add_cores(int turns) {
  const auto on = [](unsigned count) {
    // The names before and after PoCL 5.
    return ProgramCall{.study = kMap,
                       .overrides = with_counts(kUsual, 160, 120),
                       .environment = {fmt::format("POCL_MAX_PTHREAD_COUNT={}", count),
                                       fmt::format("POCL_CPU_MAX_CU_COUNT={}", count)}};
  };
  add_study("cores/1", turns, on(1));
  for (unsigned count = 2; count <= cores(); count *= 2) {
    add(fmt::format("cores/{}", count), turns, on(count), [=](Figures* figures) {
      const ProgramCost cost = run(on(count));
      add_figures(cost, figures);
      figures->add("vs_one_core", run(on(1)).wall_seconds / cost.wall_seconds);
      return cost.wall_seconds;
    });
  }
}

void add_devices(int turns) {
  const std::size_t count = list_devices().size();
  for (std::size_t device = 0; count > 1 && device < count; ++device) {
    add_study(fmt::format("devices/{}", device), turns,
              {.study = kMap,
               .overrides = with_counts(kUsual, 160, 120),
               .options = {"--device", std::to_string(device)}});
  }
}

void add_stopping(int turns, std::size_t count) {
  ProgramCall stopping = {
      .study = "coarse-backlash",
      .overrides = {fmt::format("axes.omega.count={}", count),
                    fmt::format("axes.b.count={}", count),
                    R"(observe.quantities=["x1_rms", "dmf_rms", "period", "lyapunov_max"])"}};
  ProgramCall whole = stopping;
  whole.overrides.emplace_back("integrate.stop=never");
  add(fmt::format("stopping/{0}x{0}", count), turns, stopping, [=](Figures* figures) {
    const ProgramCost cost = run(stopping);
    add_figures(cost, figures);
    figures->add("vs_never", run(whole).wall_seconds / cost.wall_seconds);
    return cost.wall_seconds;
  });
}

// Bytes of peak memory for each of the `points` that `much` has more than `little`.
void add_memory(const std::string& name, int turns, const ProgramCall& little,
                const ProgramCall& much, double points) {
  add("memory/" + name, turns, little, [=](Figures* figures) {
    const ProgramCost more = run(much);
    figures->add("bytes/point", (more.peak_bytes - run(little).peak_bytes) / points);
    figures->add("peak_bytes", more.peak_bytes);
    return more.wall_seconds;
  });
}

// The memory of one map, of six, and in tiles. little: points along each axis; the other study has
// four times as many.
void add_memory(int turns, std::size_t little) {
  const auto map = [](std::size_t count, const std::string& override) {
    std::vector<std::string> overrides = with_counts(kFewest, count, count);
    overrides.push_back(override);
    return ProgramCall{.study = kMap, .overrides = overrides};
  };
  const auto add_maps = [&](const std::string& name, const std::string& quantities) {
    const std::string override = fmt::format("observe.quantities=[{}]", quantities);
    add_memory(name, turns, map(little, override), map(4 * little, override),
               15.0 * static_cast<double>(little * little));
  };
  add_maps("one_map", "\"x1_rms\"");
  add_maps("six_maps", "\"x1_min\", \"x1_max\", \"x1_mean\", \"x1_rms\", \"x1_std\", \"dmf_max\"");
  constexpr std::size_t kSmallTile = 128 * 128, kLargeTile = 512 * 512;
  const auto tile = [&](std::size_t size) {
    return map(512, fmt::format("integrate.tile={}", size));
  };
  add_memory("tile", turns, tile(kSmallTile), tile(kLargeTile), kLargeTile - kSmallTile);
}

}  // namespace

void add_benchmarks(bool all) {
  constexpr int kTurns = 5;
  const int turns = all ? kTurns : 1;
  const auto add_points = [&](int times, std::size_t x, std::size_t y) {
    const ProgramCall first = {.study = kMap, .overrides = with_counts(kBrief, 40, 25)};
    add_study(fmt::format("points/{}", x * y), times, first,
              {.study = kMap, .overrides = with_counts(kBrief, x, y)});
  };
  if (all) {
    add_study("study/coarse-map", turns, {.study = "coarse-map"});
    add_study("study/coarse-bifurcation", turns, {.study = "coarse-bifurcation"});
    add_study("study/coarse-chaos_160x120", turns,
              {.study = "coarse-chaos", .overrides = with_counts({}, 160, 120)});
  } else {
    add_study("study/coarse-map_48x36", turns,
              {.study = "coarse-map", .overrides = with_counts({}, 48, 36)});
  }
  add_points(turns, 40, 25);
  add_points(turns, 125, 80);
  if (all) {
    add_points(turns, 400, 250);
    add_points(turns, 1250, 800);
    add_points(1, 4096, 4096);
  }
  add_cores(turns);
  add_devices(turns);
  // A turn takes minutes.
  add_stopping(1, all ? 512 : 16);
  add_memory(turns, all ? 512 : 128);
}

}  // namespace gearsweep::bench
