#include "explore/messages.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "explore/detail/message_parts.hpp"
#include "model/error.hpp"
#include "result/si_units.hpp"

namespace gearsweep {
namespace {

using nlohmann::json;

static_assert(std::endian::native == std::endian::little, "records are little-endian");

// {"factor": of one such unit, "unit": "rpm", "meaning": "pinion speed", where it is another}
json si_message(const std::string& unit, const Scales& scales) {
  const SiUnit si = shown_unit(unit, scales);
  if (si.scale <= 0.0) return nullptr;
  return {{"factor", si.scale}, {"unit", si.name}, {"meaning", si.axis_meaning}};
}

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
          {"to", scene.first_view()[number][1]},
          {"si", si_message(axis.unit, scene.study().scales)}};
}

// The quantity that is the error of another one.
json error_of(const Quantity& quantity, const Selection& selection) {
  const std::string name = quantity.name + "_error";
  const bool is_there =
      std::ranges::find(selection.quantities, name, &Quantity::name) != selection.quantities.end();
  return is_there ? json(name) : json(nullptr);
}

json quantity_message(const Quantity& quantity, const Study& study) {
  return {{"name", quantity.name},
          {"unit", quantity.unit},
          {"meaning", quantity.meaning},
          {"classes", quantity.flags.empty() ? json(nullptr) : json(quantity.flags)},
          {"is_exponent", quantity.role == OutputRole::exponent},
          {"error", error_of(quantity, study.selection)},
          {"si", si_message(quantity.unit, study.scales)}};
}

json choices_message(const Scene& scene) {
  const Study& study = scene.study();
  const std::vector<double> start = scene.start();
  const std::vector<StateRange>* const ranges = scene.state_ranges();
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
                       {"max", number_or_null(info.max)},
                       {"si", si_message(info.unit, study.scales)}});
  }
  for (std::size_t i = 0; i < model.states.size(); ++i) {
    const ChannelInfo& state = model.states[i];
    choices.push_back({{"name", state.name},
                       {"unit", state.unit},
                       {"meaning", state.meaning},
                       {"is_state", true},
                       {"value", number_or_null(start[i])},
                       {"min", nullptr},
                       {"max", nullptr},
                       {"low", ranges == nullptr ? json(nullptr) : json((*ranges)[i].low)},
                       {"high", ranges == nullptr ? json(nullptr) : json((*ranges)[i].high)},
                       {"si", si_message(state.unit, study.scales)}});
  }
  return choices;
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

std::string record(const std::array<double, 8>& head, std::string_view numbers) {
  std::string out(sizeof(head) + numbers.size(), '\0');
  std::memcpy(out.data(), head.data(), sizeof(head));
  std::memcpy(out.data() + sizeof(head), numbers.data(), numbers.size());
  return out;
}

double count(const std::vector<double>& numbers) { return static_cast<double>(numbers.size()); }

std::string_view bytes(const std::vector<double>& numbers) {
  return {reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(double)};
}

// Why the curves of the file are not drawn over a scene; empty: they are, or there are none.
std::string curves_note(const std::optional<PlaneDifference>& difference) {
  if (!difference) return "";
  return fmt::format("curves are not shown: they are {}, the map is {}", difference->of_curves,
                     difference->of_map);
}

}  // namespace

std::string scene_message(const Explorer& explorer, const Scene& scene) {
  const Study& study = scene.study();
  json quantities = json::array();
  for (const Quantity& quantity : study.selection.quantities) {
    quantities.push_back(quantity_message(quantity, study));
  }
  const std::optional<PlaneDifference> difference = explorer.difference_of_curves(scene);
  return json({{"key", scene.key()},
               {"title", study.title},
               {"model", study.model->name},
               {"source", explorer.source()},
               {"axes", {axis_message(scene, 0), axis_message(scene, 1)}},
               {"quantities", std::move(quantities)},
               {"choices", choices_message(scene)},
               {"section", study.model->state_names()},
               {"has_data", explorer.data(scene) != nullptr},
               {"has_curves", explorer.curves() != nullptr && !difference},
               {"curves_note", curves_note(difference)},
               {"one_axis", explorer.has_one_axis()},
               {"tile", TilePlace::kCells},
               {"max_depth", TilePlace::kMaxDepth},
               {"points_per_second", explorer.points_per_second()},
               {"step",
                study.integrate.steps_per_period > 0
                    ? fmt::format("{} steps in each period", study.integrate.steps_per_period)
                    : fmt::format("steps of at most {:.6g}{}", study.integrate.max_step,
                                  FoundStep::of(study).words_of_orbits())},
               {"notices", study.notices},
               {"command", explorer.is_model() ? json(nullptr)
                                               : json("gearsweep run " + explorer.source() +
                                                      sets_text(explorer, scene.changes().sets))}})
      .dump();
}

std::string motion_message(const Explorer& explorer, const Scene& scene, const Motion& motion) {
  const std::string at = at_text(explorer, scene, motion.at);
  json message = {{"label", label_of(*motion.study.model, find_place(motion.study, motion.at, ""))},
                  {"status", has_values(motion.status)          ? "ok"
                             : motion.status == STATUS_diverged ? "diverged"
                                                                : "step_too_long"},
                  {"values", values_message(motion)},
                  {"commands", json::array()}};
  if (!explorer.is_model()) {
    const std::string what =
        explorer.source() + sets_text(explorer, scene.changes().sets) + " --at " + at;
    message["commands"] = {fmt::format("gearsweep trace {} -o trace.nc", what),
                           fmt::format("gearsweep floquet {}", what)};
  }
  add_motion(motion, &message);
  return dumped(message);
}

std::string orbit_message(const MotionOrbit& orbit) {
  json values = json::array();
  for (const std::complex<double>& multiplier : orbit.multipliers) {
    values.push_back({number_or_null(multiplier.real()), number_or_null(multiplier.imag())});
  }
  const char* stable = orbit.is_stable ? "stable" : "unstable";
  return json({{"values", std::move(values)},
               {"stable", orbit.is_stable},
               {"period", orbit.period},
               {"text", orbit.is_equilibrium
                            ? fmt::format("{} equilibrium; eigenvalues per unit of time", stable)
                            : fmt::format("{} orbit of period {}", stable, orbit.period)}})
      .dump();
}

std::string starts_message(const Scene& scene, const ReachedAttractors& reached,
                           std::size_t starts) {
  json attractors = json::array();
  for (const ReachedAttractor& attractor : reached.attractors) {
    attractors.push_back(
        {{"share", attractor.share},
         {"text", attractor.name},
         {"section",
          {{"channels", scene.study().model->state_names()}, {"points", attractor.section}}}});
  }
  return dumped({{"starts", starts},
                 {"attractors", std::move(attractors)},
                 {"undecided", reached.undecided},
                 {"diverged", reached.diverged}});
}

std::string error_message(const std::string& text) { return dumped({{"error", text}}); }

std::string tile_record(const TilePlace& place, const TileMaps& maps, double points_per_second) {
  return record(
      {0.0, static_cast<double>(place.depth), static_cast<double>(place.at[0]),
       static_cast<double>(place.at[1]), count(maps.numbers), points_per_second, maps.seconds, 0.0},
      bytes(maps.numbers));
}

std::string error_record(std::string_view text) {
  const std::size_t numbers = (text.size() + 7) / 8;
  std::string padded(text);
  padded.resize(8 * numbers, '\0');
  return record({1.0, 0.0, 0.0, 0.0, static_cast<double>(numbers), 0.0, 0.0, 0.0}, padded);
}

std::string preview_record(const Preview& preview, double points_per_second) {
  const CellBlock& cells = preview.cells;
  return record({2.0, static_cast<double>(cells.depth), static_cast<double>(cells.first[0]),
                 static_cast<double>(cells.first[1]), count(preview.numbers), points_per_second,
                 preview.seconds, static_cast<double>(cells.count[0])},
                bytes(preview.numbers));
}

std::string strip_record(const Line& line, const Strip& strip, const StripMaps& maps,
                         double points_per_second) {
  return record({3.0, static_cast<double>(strip.depth), static_cast<double>(strip.at),
                 static_cast<double>(line.axis), count(maps.numbers), points_per_second,
                 maps.seconds, static_cast<double>(maps.samples)},
                bytes(maps.numbers));
}

std::string data_record(const Scene& scene, const ResultData& data) {
  std::vector<double> numbers;
  for (std::size_t axis = 0; axis < 2; ++axis) {
    for (const double value : data.values[axis]) numbers.push_back(scene.share_of(axis, value));
  }
  for (const std::vector<double>& values : data.values) {
    numbers.insert(numbers.end(), values.begin(), values.end());
  }
  numbers.insert(numbers.end(), data.numbers.begin(), data.numbers.end());
  return record({4.0, 0.0, 0.0, 0.0, count(numbers), static_cast<double>(data.values[0].size()),
                 static_cast<double>(data.values[1].size()), 0.0},
                bytes(numbers));
}

}  // namespace gearsweep
