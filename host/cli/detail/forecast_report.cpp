#include "cli/detail/forecast_report.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>

#include "cli/detail/pilot_report.hpp"
#include "cli/detail/progress_bar.hpp"
#include "cli/detail/summary.hpp"
#include "result/json_text.hpp"

namespace gearsweep {
namespace {

// " of 3 GB", where that is known.
std::string out_of(const std::optional<double>& bytes) {
  return bytes ? fmt::format(" of {} available", format_bytes(*bytes)) : "";
}

std::int64_t whole(double bytes) { return std::llround(bytes); }

// JSON has no infinity: null where there is no limit.
nlohmann::json limit_as_json(double bytes) {
  return std::isfinite(bytes) ? nlohmann::json(whole(bytes)) : nlohmann::json();
}

nlohmann::json known_as_json(const std::optional<double>& bytes) {
  return bytes ? nlohmann::json(whole(*bytes)) : nlohmann::json();
}

}  // namespace

std::string describe_forecast(const Forecast& forecast, const std::string& output) {
  const ResourceEstimate& estimate = forecast.estimate;
  std::string text = fmt::format("{}: {} points", output, forecast.points);
  if (forecast.trajectories > forecast.points) {
    text += fmt::format(", {} trajectories", forecast.trajectories);
  }
  text += fmt::format("; {} tile{} of up to {}\n", forecast.tiles, forecast.tiles == 1 ? "" : "s",
                      forecast.tile_points);
  const std::string integrated = describe_integrated(forecast.integrated, forecast.states);
  if (!integrated.empty()) text += "states  " + integrated;
  if (const std::string steps = describe_steps(forecast.study, forecast.pilot); !steps.empty()) {
    text += "steps   " + steps;
  }
  text += fmt::format(
      "time    {}about {} for the tiles: {:.2g} steps planned, estimated from a run of {} points\n",
      forecast.has_whole_sample ? "" : "up to ", format_duration(forecast.seconds), forecast.steps,
      forecast.sample);
  text += fmt::format("memory  up to {}{}\n", format_bytes(estimate.memory()),
                      out_of(estimate.memory_left));
  for (const DeviceEstimate& device : estimate.devices) {
    if (device.tile.device == 0.0) continue;
    text += fmt::format("device  {}: buffers up to {} of {}, each up to {} of {}\n", device.name,
                        format_bytes(device.tile.device), format_bytes(device.memory.all),
                        format_bytes(device.tile.buffer), format_bytes(device.memory.one_buffer));
  }
  text += fmt::format("disk    up to {} for the result, {} for the journal while it runs{}\n",
                      format_bytes(estimate.result), format_bytes(estimate.journal),
                      out_of(estimate.disk_left));
  return text;
}

std::string forecast_as_json(const Forecast& forecast) {
  const ResourceEstimate& estimate = forecast.estimate;
  nlohmann::json json = {{"points", forecast.points},
                         {"trajectories", forecast.trajectories},
                         {"tiles", forecast.tiles},
                         {"tile_points", forecast.tile_points},
                         {"steps", forecast.steps},
                         {"seconds", forecast.seconds},
                         {"sample_points", forecast.sample},
                         {"sample_is_whole", forecast.has_whole_sample},
                         {"memory_bytes", whole(estimate.memory())},
                         {"memory_bytes_of_program", whole(estimate.program)},
                         {"memory_bytes_left", known_as_json(estimate.memory_left)},
                         {"result_bytes", whole(estimate.result)},
                         {"journal_bytes", whole(estimate.journal)},
                         {"disk_bytes_left", known_as_json(estimate.disk_left)}};
  json["integrated_states"] = forecast.integrated;
  json["max_step"] = forecast.study.integrate.max_step;
  json["orbit_steps"] = forecast.study.integrate.orbit_steps;
  if (forecast.pilot) json["pilot"] = pilot_as_json(*forecast.pilot);
  json["devices"] = nlohmann::json::array();
  for (const DeviceEstimate& device : estimate.devices) {
    json["devices"].push_back(
        {{"name", device.name},
         {"tile_bytes", whole(device.tile.device)},
         {"tile_bytes_of_largest_buffer", whole(device.tile.buffer)},
         {"memory_bytes", limit_as_json(device.memory.all)},
         {"memory_bytes_of_one_buffer", limit_as_json(device.memory.one_buffer)}});
  }
  return json_text(json);
}

}  // namespace gearsweep
