#include "cli/summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/progress_bar.hpp"
#include "sweep_types.h"

namespace gearsweep {
namespace {

struct Count {
  std::string name;
  std::size_t points;
};

std::vector<Count> count_statuses(const SweepResult& result) {
  std::vector<Count> counts;
  const auto add = [&](const char* name, int code) {
    const auto points = std::count(result.status.begin(), result.status.end(), code);
    if (points > 0) counts.push_back({name, static_cast<std::size_t>(points)});
  };
#define ADD_STATUS(name, code, meaning) add(#name, code);
  SWEEP_STATUSES(ADD_STATUS)
#undef ADD_STATUS
  return counts;
}

std::vector<Count> count_classes(const Quantity& quantity, const std::vector<double>& map) {
  std::vector<Count> counts;
  for (std::size_t i = 0; i < quantity.flags.size(); ++i) {
    const auto points = std::count(map.begin(), map.end(), static_cast<double>(i));
    counts.push_back({quantity.flags[i], static_cast<std::size_t>(points)});
  }
  return counts;
}

std::string describe_counts(const std::vector<Count>& counts) {
  std::string text;
  for (const Count& count : counts) {
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count.name, count.points);
  }
  return text;
}

nlohmann::json counts_as_json(const std::vector<Count>& counts) {
  nlohmann::json json = nlohmann::json::object();
  for (const Count& count : counts) json[count.name] = count.points;
  return json;
}

}  // namespace

std::string describe_run(const SweepResult& result, const std::string& path) {
  std::string text =
      fmt::format("{} points: {}\n", result.status.size(), describe_counts(count_statuses(result)));
  for (std::size_t i = 0; i < result.values.size(); ++i) {
    const Quantity& quantity = result.study.selection.quantities[i];
    if (quantity.flags.empty()) continue;
    text += fmt::format("{}: {}\n", quantity.name,
                        describe_counts(count_classes(quantity, result.values[i])));
  }
  text += fmt::format("{} on {}", format_duration(result.seconds), result.engine.device);
  if (result.steps > 0.0) {
    text += fmt::format(", {:.3g} steps, {:.1f} M steps/s", result.steps,
                        result.steps / result.seconds / 1e6);
  }
  return text + fmt::format("\n{}\n", path);
}

std::string run_as_json(const SweepResult& result, const std::string& path) {
  nlohmann::json json;
  json["file"] = path;
  json["points"] = result.status.size();
  json["status"] = counts_as_json(count_statuses(result));
  json["classes"] = nlohmann::json::object();
  for (std::size_t i = 0; i < result.values.size(); ++i) {
    const Quantity& quantity = result.study.selection.quantities[i];
    if (quantity.flags.empty()) continue;
    json["classes"][quantity.name] = counts_as_json(count_classes(quantity, result.values[i]));
  }
  json["seconds"] = result.seconds;
  json["steps"] = result.steps;
  json["device"] = result.engine.device;
  return json.dump(2) + "\n";
}

}  // namespace gearsweep
