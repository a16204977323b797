#include "study/as_built.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "model/error.hpp"

namespace gearsweep {
namespace {

constexpr int kHeardOrders = 3;  // of the transmission error

// The force first, what gears are judged by, and what an engineer looks at beside it.
std::vector<std::string> looked_at(const Model& model, AsBuilt* built) {
  const std::vector<Quantity> offered = offered_quantities(model);
  const auto is_offered = [&](const std::string& name) {
    return std::ranges::find(offered, name, &Quantity::name) != offered.end();
  };
  std::vector<std::string> wanted;
  const auto add = [&](const std::string& name) {
    if (is_offered(name)) wanted.push_back(name);
  };
  // Those of the mesh frequency that are heard.
  const auto add_orders = [&](const std::string& channel, int last) {
    if (!is_offered(channel + "_order_amplitude")) return;
    for (int order = 1; order <= last; ++order) {
      wanted.push_back(fmt::format("{}_order_{}_amplitude", channel, order));
    }
  };
  for (const ChannelInfo& signal : model.signals_of(Role::mesh_force)) add(signal.name + "_max");
  if (wanted.empty()) wanted.push_back(model.states.front().name + "_max");
  built->force = built->target = wanted.front();
  for (const Quantity& quantity : offered) {
    if (!quantity.divided_by || quantity.width != 1) continue;
    built->target = quantity.name;
    wanted.push_back(quantity.name);
    break;
  }
  for (const ChannelInfo& signal : model.signals_of(Role::transmission_error)) {
    add(signal.name + "_peak_to_peak");
    add_orders(signal.name, kHeardOrders);
  }
  for (const ChannelInfo& signal : model.signals_of(Role::bearing_force)) {
    add(signal.name + "_max");
    add_orders(signal.name, 1);
  }
  // Of one contact, or of each.
  for (const Quantity& quantity : offered) {
    if (is_contact_class(quantity.name)) wanted.push_back(quantity.name);
  }
  return wanted;
}

std::vector<std::string> as_built_overrides(const Study& study, const AsBuiltOptions& options,
                                            AsBuilt* built) {
  std::vector<std::string> overrides = {
      fmt::format("observe.quantities=[\"{}\"]",
                  fmt::join(looked_at(*study.model, built), "\", \"")),
      "observe.orders=[1, 2, 3]",
      fmt::format("uncertain.samples={}", options.gears),
      "uncertain.start=\"nominal\"",
      "uncertain.keep=true",
      "uncertain.sobol=false",
      fmt::format("uncertain.percentiles=[{:.6g}, 50, {:.6g}]", 100.0 - options.percentile,
                  options.percentile)};
  for (const UsualTolerance& one : built->assumed) {
    overrides.push_back(fmt::format("uncertain.{}={}", one.name, one.distribution));
  }
  return overrides;
}

}  // namespace

bool is_contact_class(const std::string& quantity) {
  constexpr const char* kContactClass = "contact_class";
  return quantity == kContactClass || quantity.ends_with(std::string("_") + kContactClass);
}

AsBuilt as_built(const Study& study, const AsBuiltOptions& options) {
  const auto is_point_list = [](const Axis& axis) { return axis.name == kPointAxis; };
  if (std::ranges::any_of(study.axes, is_point_list)) {
    throw InputError(
        "gears as built are looked at over a speed alone, and the study has a list of points: "
        "leave "
        "out [points], give one of its loads, as in --set gear.torque_N_m=60, and [[axes]] with "
        "name = \"pinion_speed_rpm\"");
  }
  if (study.axes.size() != 1) {
    throw InputError(
        "gears as built are looked at over a speed alone, and the study has two axes: take one "
        "away, as with --set 'axes=[{name = \"omega\", from = 0.5, to = 1.5, count = 60}]'");
  }
  AsBuilt built;
  if (study.uncertain.draws() == 0) {
    built.assumed = usual_tolerances(study, options.tolerance_class);
  }
  built.study =
      read_study(study.toml, "the study as built", as_built_overrides(study, options, &built));
  return built;
}

}  // namespace gearsweep
