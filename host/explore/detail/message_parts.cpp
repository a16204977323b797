#include "explore/detail/message_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace gearsweep {
namespace {

using nlohmann::json;

void add_trace(const Motion& motion, json* message) {
  const Trace& trace = *motion.trace;
  json channels = json::array(), names = json::array(), points = json::array();
  for (const ChannelInfo& channel : trace.channels) {
    channels.push_back({{"name", channel.name},
                        {"unit", channel.unit},
                        {"meaning", channel.meaning},
                        {"velocity", channel.velocity}});
    names.push_back(channel.name);
  }
  for (std::size_t i = 0; i < trace.tau.size() && !trace.is_clockless;
       i += motion.samples_per_period) {
    json point = json::array();
    for (const std::vector<double>& series : trace.values) point.push_back(series[i]);
    points.push_back(std::move(point));
  }
  (*message)["period"] = trace.period;
  (*message)["clockless"] = trace.is_clockless;
  (*message)["time_unit"] = "dimensionless time";
  (*message)["channels"] = std::move(channels);
  (*message)["tau"] = trace.tau;
  (*message)["series"] = trace.values;
  (*message)["section"] = {{"channels", names}, {"points", std::move(points)}};
  if (!motion.spectrum) return;
  json orders = json::array();
  for (std::size_t i = 0; i < motion.spectrum->amplitude.front().size(); ++i) {
    orders.push_back(motion.spectrum->order_step * static_cast<double>(i));
  }
  (*message)["spectrum"] = {
      {"order", std::move(orders)}, {"channels", names}, {"amplitude", motion.spectrum->amplitude}};
}

}  // namespace

json number_or_null(double value) { return std::isfinite(value) ? json(value) : json(nullptr); }

std::string dumped(const json& message) {
  return message.dump(-1, ' ', false, json::error_handler_t::replace);
}

std::string sets_text(const Explorer& explorer, const std::vector<NamedValue>& sets) {
  std::string text;
  for (const std::string& set : overrides_of(explorer.study(), sets)) {
    text += " --set '" + set + "'";
  }
  return text;
}

std::string at_text(const Explorer& explorer, const Scene& scene,
                    const std::vector<NamedValue>& at) {
  std::string text;
  const auto add = [&](const std::string& name, double value) {
    text += fmt::format("{}{}={}", text.empty() ? "" : ",", name, value);
  };
  for (const auto& [name, value] : at) add(name, value);
  const Study& study = scene.study();
  for (const Axis& axis : explorer.study().axes) {
    if (std::ranges::find(at, axis.name, &NamedValue::name) != at.end()) continue;
    add(axis.name,
        axis.is_state ? scene.start()[axis.index] : study.setting.parameters[axis.index]);
  }
  return text;
}

void add_motion(const Motion& motion, json* message) {
  for (const auto& [name, value] : motion.at) {
    (*message)["at"].push_back({{"name", name}, {"value", value}});
  }
  (*message)["notes"] = motion.notes;
  (*message)["on_orbit"] = motion.is_on_orbit;
  if (motion.trace) add_trace(motion, message);
}

}  // namespace gearsweep
