#include "explore/messages.hpp"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "model/error.hpp"

namespace gearsweep {
namespace {

using nlohmann::json;

static_assert(std::endian::native == std::endian::little, "records are little-endian");

// No number in JSON.
json number_or_null(double value) { return std::isfinite(value) ? json(value) : json(nullptr); }

json axis_message(const Scene& scene, std::size_t number) {
  const Axis& axis = scene.study().axes[number];
  return {{"name", axis.name},
          {"unit", axis.unit},
          {"meaning", axis.meaning},
          {"is_state", axis.is_state},
          {"log", axis.logarithmic},
          {"low", axis.values.front()},
          {"high", axis.values.back()},
          {"from", scene.first_view()[number][0]},
          {"to", scene.first_view()[number][1]}};
}

json quantity_message(const Quantity& quantity) {
  return {{"name", quantity.name},
          {"unit", quantity.unit},
          {"meaning", quantity.meaning},
          {"classes", quantity.flags.empty() ? json(nullptr) : json(quantity.flags)},
          {"is_exponent", quantity.name == "lyapunov_max"}};
}

json choices_message(const Study& study) {
  json choices = json::array();
  const Model& model = *study.model;
  for (std::size_t i = 0; i < model.parameters.size(); ++i) {
    if (model.find_derived(i) != nullptr) continue;
    const ParameterInfo& info = model.parameters[i];
    choices.push_back({{"name", info.name},
                       {"unit", info.unit},
                       {"meaning", info.meaning},
                       {"is_state", false},
                       {"value", study.setting.parameters[i]},
                       {"min", number_or_null(info.min)},
                       {"max", number_or_null(info.max)}});
  }
  for (const ChannelInfo& state : model.states) {
    choices.push_back({{"name", state.name},
                       {"unit", state.unit},
                       {"meaning", state.meaning},
                       {"is_state", true},
                       {"value", nullptr},
                       {"min", nullptr},
                       {"max", nullptr}});
  }
  return choices;
}

// "omega=0.7,b=1", with all digits.
std::string at_text(const Motion& motion) {
  std::string text;
  for (const auto& [name, value] : motion.at) {
    text += fmt::format("{}{}={}", text.empty() ? "" : ",", name, value);
  }
  return text;
}

std::string text_of(const Quantity& quantity, double value) {
  const auto number = static_cast<std::size_t>(std::max(value, 0.0));
  if (std::isfinite(value) && number < quantity.flags.size()) return quantity.flags[number];
  return std::isfinite(value) ? fmt::format("{:.6g}", value) : "none";
}

json values_message(const Motion& motion) {
  json values = json::array();
  for (std::size_t i = 0; i < motion.values.size(); ++i) {
    const Quantity& quantity = motion.study.selection.quantities[i];
    values.push_back({{"name", quantity.name},
                      {"value", number_or_null(motion.values[i])},
                      {"text", text_of(quantity, motion.values[i])}});
  }
  return values;
}

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

json orbit_message(const MotionOrbit& orbit) {
  json values = json::array();
  for (const std::complex<double>& multiplier : orbit.multipliers) {
    values.push_back({number_or_null(multiplier.real()), number_or_null(multiplier.imag())});
  }
  const char* stable = orbit.is_stable ? "stable" : "unstable";
  return {{"values", std::move(values)},
          {"stable", orbit.is_stable},
          {"period", orbit.period},
          {"text", orbit.is_equilibrium
                       ? fmt::format("{} equilibrium; eigenvalues per unit of time", stable)
                       : fmt::format("{} orbit of period {}", stable, orbit.period)}};
}

std::string record(const std::array<double, 8>& head, std::string_view numbers) {
  std::string out(sizeof(head) + numbers.size(), '\0');
  std::memcpy(out.data(), head.data(), sizeof(head));
  std::memcpy(out.data() + sizeof(head), numbers.data(), numbers.size());
  return out;
}

}  // namespace

std::string scene_message(const Explorer& explorer, const Scene& scene) {
  const Study& study = scene.study();
  json quantities = json::array();
  for (const Quantity& quantity : study.selection.quantities) {
    quantities.push_back(quantity_message(quantity));
  }
  return json({{"key", scene.key()},
               {"title", study.title},
               {"model", study.model->name},
               {"source", explorer.source()},
               {"axes", {axis_message(scene, 0), axis_message(scene, 1)}},
               {"quantities", std::move(quantities)},
               {"choices", choices_message(study)},
               {"tile", TilePlace::kCells},
               {"max_depth", TilePlace::kMaxDepth},
               {"points_per_second", explorer.points_per_second()},
               {"step",
                study.integrate.steps_per_period > 0
                    ? fmt::format("{} steps in each period", study.integrate.steps_per_period)
                    : fmt::format("steps of at most {:.6g}", study.integrate.max_step)},
               {"notices", study.notices},
               {"command", "gearsweep run " + explorer.source()}})
      .dump();
}

std::string motion_message(const Explorer& explorer, const Motion& motion) {
  const std::string at = at_text(motion);
  json message = {{"label", label_of(*motion.study.model, find_place(motion.study, motion.at, ""))},
                  {"status", has_values(motion.status) ? "ok" : "diverged"},
                  {"values", values_message(motion)},
                  {"notes", motion.notes},
                  {"commands",
                   {fmt::format("gearsweep trace {} --at {} -o trace.nc", explorer.source(), at),
                    fmt::format("gearsweep floquet {} --at {}", explorer.source(), at)}}};
  for (const auto& [name, value] : motion.at) {
    message["at"].push_back({{"name", name}, {"value", value}});
  }
  if (motion.trace) add_trace(motion, &message);
  if (motion.orbit) message["multipliers"] = orbit_message(*motion.orbit);
  return message.dump(-1, ' ', false, json::error_handler_t::replace);
}

std::string error_message(const std::string& text) {
  return json({{"error", text}}).dump(-1, ' ', false, json::error_handler_t::replace);
}

std::string tile_record(const TilePlace& place, const TileMaps& maps, double points_per_second) {
  const auto n = static_cast<double>(maps.numbers.size());
  return record({0.0, static_cast<double>(place.depth), static_cast<double>(place.at[0]),
                 static_cast<double>(place.at[1]), n, points_per_second, maps.seconds, 0.0},
                {reinterpret_cast<const char*>(maps.numbers.data()), bytes_of(maps)});
}

std::string error_record(std::string_view text) {
  const std::size_t numbers = (text.size() + 7) / 8;
  std::string padded(text);
  padded.resize(numbers * 8, '\0');
  return record({1.0, 0.0, 0.0, 0.0, static_cast<double>(numbers), 0.0, 0.0, 0.0}, padded);
}

}  // namespace gearsweep
