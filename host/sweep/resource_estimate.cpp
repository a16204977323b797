#include "sweep/resource_estimate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "attractors/attractor_census.hpp"
#include "model/error.hpp"
#include "study/draw_quantities.hpp"
#include "sweep/detail/machine.hpp"

namespace gearsweep {
namespace {

// The share of a device's memory that tiles may take; drivers and other programs have some.
constexpr double kShareOfDevice = 0.75;
// Measured: the program, the OpenCL driver, and its compiler at work on the largest kernels.
constexpr double kProgram = 256e6;

double block(std::size_t bytes) { return static_cast<double>(16 + bytes); }  // of the heap

double memory_of_maps(const Study& study, std::size_t tiles) {
  const auto points = static_cast<double>(study.points());
  const auto trajectories = static_cast<double>(study.trajectories());
  const std::size_t states = study.model->states.size();
  double numbers = static_cast<double>(study.selection.poincare.size() * study.integrate.record);
  for (const Quantity& quantity : study.selection.quantities) {
    numbers += static_cast<double>(quantity.width);
  }
  if (study.stages() > 1) numbers += static_cast<double>(states);
  // The plan's lists of points, one by phase grids and one by tiles, which grow by doubling: of
  // runs, each of two points at least. And the tiles themselves.
  constexpr double kOfTrajectory = 32.0, kOfTile = 512.0;
  double bytes = points * (1.0 + 8.0 * numbers) + kOfTrajectory * trajectories +
                 kOfTile * static_cast<double>(tiles);
  // Until all are there, the numbers of all draws, of which their maps are made.
  const auto kept = std::ranges::count_if(study.selection.quantities, has_draw_quantities);
  bytes += points * static_cast<double>(study.uncertain.draws()) *
           (1.0 + 8.0 * static_cast<double>(kept));
  // The place of a trajectory, and the errors of that; telling the attractors apart takes a few
  // indices more, and a set for each point.
  if (study.selection.census) {
    bytes += trajectories * (sizeof(TrajectorySummary) + 4.0 * block(2 * sizeof(double) * states));
  }
  return bytes;
}

// SQLite stores numbers in pages, one of the last of each blob half empty.
double journal_size(const Study& study, std::size_t tiles) {
  constexpr double kPage = 4096.0, kUsed = 4080.0, kPagesOfTile = 3.0, kPagesOfAll = 16.0;
  double of_point = answer_bytes(study);
  if (!study.is_chained()) {
    of_point -= static_cast<double>(sizeof(double) * study.model->states.size());
  }
  const double data = static_cast<double>(study.trajectories()) * of_point;
  return data * kPage / kUsed + kPage * kPagesOfTile * static_cast<double>(tiles) +
         kPage * kPagesOfAll + 2.0 * static_cast<double>(study.toml.size());
}

// The least number of tiles of any plan of the study.
std::size_t min_tiles(const Study& study) {
  const std::size_t stages = study.stages();
  if (study.integrate.tile == 0) return stages;
  const std::size_t points = study.trajectories() / stages;
  return stages * ((points + study.integrate.tile - 1) / study.integrate.tile);
}

std::string folder_of(const std::string& path) {
  return std::filesystem::path(path).parent_path().string();
}

double size_of_file(const std::string& path) {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  return error ? 0.0 : static_cast<double>(size);
}

void take_max(const TileMemory& tile, TileMemory* most) {
  most->device = std::max(most->device, tile.device);
  most->buffer = std::max(most->buffer, tile.buffer);
  most->host = std::max(most->host, tile.host);
}

ResourceEstimate estimate_of(const Study& study, const DeliveryEstimate& delivery,
                             const std::string& journal_path, std::size_t tiles) {
  ResourceEstimate estimate;
  estimate.program = kProgram;
  estimate.maps = memory_of_maps(study, tiles);
  estimate.delivery = delivery.memory;
  estimate.result = delivery.file;
  estimate.memory_left = available_memory();
  if (!journal_path.empty()) {
    estimate.journal = journal_size(study, tiles);
    estimate.disk_left = available_disk(folder_of(journal_path));
    estimate.journal_there = size_of_file(journal_path);
  }
  return estimate;
}

}  // namespace

ResourceEstimate estimate_of_study(const Study& study, const DeliveryEstimate& delivery,
                                   const std::string& journal_path) {
  return estimate_of(study, delivery, journal_path, min_tiles(study));
}

ResourceEstimate estimate_of_plan(const Plan& plan,
                                  const std::vector<std::unique_ptr<Engine>>& engines,
                                  const DeliveryEstimate& delivery,
                                  const std::string& journal_path) {
  std::size_t tiles = 0;
  for (const Stage& stage : plan.stages()) tiles += stage.tiles.size();
  ResourceEstimate estimate = estimate_of(plan.study(), delivery, journal_path, tiles);
  // One that is finished waits for the disk while the next ones are computed.
  estimate.tiles = static_cast<double>(plan.tile_points()) * answer_bytes(plan.study());
  for (const std::unique_ptr<Engine>& engine : engines) {
    DeviceEstimate device = {engine->info().device, {}, engine->memory()};
    for (const Stage& stage : plan.stages()) {
      for (const Tile& tile : stage.tiles) {
        take_max(engine->tile_memory(plan, tile), &device.tile);
      }
    }
    estimate.tiles += device.tile.host + (device.memory.is_host ? device.tile.device : 0.0);
    // Engines on one device, or on parts of it, share its memory.
    const auto same =
        std::find_if(estimate.devices.begin(), estimate.devices.end(),
                     [&](const DeviceEstimate& other) { return other.name == device.name; });
    if (same == estimate.devices.end()) {
      estimate.devices.push_back(std::move(device));
    } else {
      same->tile.device += device.tile.device;
      same->tile.buffer = std::max(same->tile.buffer, device.tile.buffer);
    }
  }
  return estimate;
}

void refuse_too_large(const ResourceEstimate& estimate, const std::string& journal_path) {
  if (estimate.memory_left && estimate.memory() > *estimate.memory_left) {
    throw InputError(fmt::format(
        "the study needs up to {} of memory ({} of it for its maps and samples), and {} are "
        "available; take fewer points (axes.NAME.count), fewer quantities, sample fewer states "
        "(observe.poincare) or periods (integrate.record), or cut it in several studies",
        format_bytes(estimate.memory()), format_bytes(estimate.maps),
        format_bytes(*estimate.memory_left)));
  }
  if (estimate.disk_left && estimate.disk() > *estimate.disk_left) {
    const std::string folder = folder_of(journal_path);
    const std::string files =
        estimate.journal_there > 0.0
            ? fmt::format("the journal '{}' may grow by {}", journal_path,
                          format_bytes(estimate.disk()))
            : fmt::format(
                  "the study needs up to {} of disk ({} for its journal while it runs, {} "
                  "for the result)",
                  format_bytes(estimate.disk()), format_bytes(estimate.journal),
                  format_bytes(estimate.result));
    throw InputError(
        fmt::format("{}, and '{}' has {}; make room there, write elsewhere (-o), take fewer points "
                    "or quantities, or sample fewer states or periods",
                    files, folder.empty() ? "." : folder, format_bytes(*estimate.disk_left)));
  }
}

double tile_memory_share(const ResourceEstimate& estimate) {
  double share = 0.0;
  for (const DeviceEstimate& device : estimate.devices) {
    share = std::max({share, device.tile.device / (kShareOfDevice * device.memory.all),
                      device.tile.buffer / device.memory.one_buffer});
  }
  if (estimate.memory_left) {
    const double left = *estimate.memory_left - (estimate.memory() - estimate.tiles);
    // Without room for the maps themselves, smaller tiles do not help.
    if (left > 0.0) share = std::max(share, estimate.tiles / left);
  }
  return share;
}

std::string format_bytes(double bytes) {
  double size = bytes;
  for (const char* unit : {"B", "kB", "MB", "GB"}) {
    if (size < 999.5) return fmt::format("{:.{}f} {}", size, size < 9.95 ? 1 : 0, unit);
    size /= 1000.0;
  }
  return fmt::format("{:.{}f} TB", size, size < 9.95 ? 1 : 0);
}

}  // namespace gearsweep
