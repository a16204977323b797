#include "report/detail/scatter_json.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "model/version.hpp"
#include "result/json_text.hpp"

namespace gearsweep {
namespace {

using nlohmann::json;  // numbers that are not finite become null

double scaled(double value, double scale) { return std::isfinite(value) ? value * scale : value; }

json speed_json(const Scatter& scatter, const ResultMap& target, std::size_t point) {
  const Percentile& one = scatter.percentiles[point];
  const double scale = scatter.scale_of(scatter.target);
  json told = {{"speed", target.axes.front().values[point]},
               {"nominal", target.values[point]},
               {"median", scatter.map(scatter.target + "_p50").values[point]},
               {"percentile", scaled(one.value, scale)},
               {"error", scaled(one.error, scale)}};
  if (!scatter.parting.empty()) told["lose_contact"] = scatter.parting[point];
  return told;
}

// The percentile of a quantity over the speed, with its error.
json percentile_json(const Scatter& scatter, const std::string& quantity, double percentile) {
  const double scale = scatter.scale_of(quantity);
  json told = {{"percent", percentile}, {"values", json::array()}, {"errors", json::array()}};
  for (std::vector<double>& row : draws_of_points(scatter.result, quantity)) {
    const Percentile one = percentile_with_error(std::move(row), percentile);
    told["values"].push_back(scaled(one.value, scale));
    told["errors"].push_back(scaled(one.error, scale));
  }
  return told;
}

json bands_json(const Scatter& scatter) {
  json bands = json::object();
  for (const Quantity& quantity : scatter.study.selection.quantities) {
    if (quantity.of_draws || !quantity.flags.empty()) continue;
    const ResultMap nominal = scatter.map(quantity.name);
    json& band = bands[quantity.name];
    band = {{"unit", nominal.unit},
            {"meaning", nominal.meaning},
            {"nominal", nominal.values},
            {"percentiles", json::array()}};
    for (const double percentile : scatter.study.uncertain.percentiles) {
      band["percentiles"].push_back(percentile_json(scatter, quantity.name, percentile));
    }
  }
  return bands;
}

json ranking_json(const Scatter& scatter) {
  const double scale = scatter.scale_of(scatter.target);
  json list = json::array();
  for (const RankedTolerance& one : scatter.ranking) {
    json& told = list.emplace_back();
    told = {{"tolerance", one.name},
            {"first", one.first},
            {"first_error", one.first_error},
            {"total", one.total},
            {"half_as_wide", nullptr}};
    if (one.tightened) told["half_as_wide"] = *one.tightened * scale;
  }
  return list;
}

json worst_gears_json(const Scatter& scatter, const ResultMap& target) {
  const double scale = scatter.scale_of(scatter.target);
  json list = json::array();
  for (const WorstGear& gear : scatter.worst_gears) {
    json parameters = json::array();
    for (const UncertainParameter& one : scatter.study.uncertain.parameters) {
      parameters.push_back({{"name", one.draws.name},
                            {"unit", one.is_factor ? "1" : one.draws.unit},
                            {"is_factor", one.is_factor},
                            {"value", one.draws.values[gear.draw]}});
    }
    list.push_back({{"draw", gear.draw},
                    {"speed", target.axes.front().values[gear.point]},
                    {"value", gear.value * scale},
                    {"parameters", std::move(parameters)},
                    {"set", gear.overrides}});
  }
  return list;
}

json assumed_json(const Scatter& scatter) {
  json list = json::array();
  for (const UsualTolerance& one : scatter.assumed) {
    list.push_back(
        {{"tolerance", one.name}, {"distribution", one.distribution}, {"why", one.reason}});
  }
  return list;
}

}  // namespace

std::string scatter_json(const Scatter& scatter, const ToleranceOptions& options) {
  const Study& study = scatter.study;
  const ResultMap target = scatter.map(scatter.target);
  json speeds = json::array();
  for (std::size_t point = 0; point < study.points(); ++point) {
    speeds.push_back(speed_json(scatter, target, point));
  }
  json told = {{"gearsweep", version()},
               {"command", options.command_line},
               {"title", study.title},
               {"model", study.model->name},
               {"gears", scatter.gears()},
               {"gears_without_value", scatter.without_value},
               {"seed", study.uncertain.seed},
               {"trajectories", study.trajectories()},
               {"judged_by", {{"quantity", target.name}, {"unit", target.unit}}},
               {"percent", options.percentile},
               {"speed", {{"name", target.axes.front().name}, {"unit", target.axes.front().unit}}},
               {"worst", speeds[scatter.worst]},
               {"speeds", std::move(speeds)},
               {"bands", bands_json(scatter)},
               {"ranking", ranking_json(scatter)},
               {"ranking_gears", scatter.tightened_gears},
               {"worst_gears", worst_gears_json(scatter, target)},
               {"assumed", assumed_json(scatter)}};
  if (!scatter.parting.empty()) told["lose_contact_at_some_speed"] = scatter.parting_anywhere;
  return json_text(told);
}

}  // namespace gearsweep
