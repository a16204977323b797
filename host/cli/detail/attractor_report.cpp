#include "cli/detail/attractor_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>

namespace gearsweep {
namespace {

double share_of(const Attractor& attractor, const SweepResult& result) {
  return static_cast<double>(attractor.trajectories) /
         static_cast<double>(result.study.trajectories());
}

std::string name_of_peak(const Model& model) { return model.contact_force()->name + "_max"; }

bool have_impacts(const std::vector<Attractor>& list) {
  return std::ranges::any_of(list, [](const Attractor& one) { return !one.impacts.empty(); });
}

}  // namespace

std::string describe_attractors(const SweepResult& result) {
  const std::vector<Attractor>& list = result.attractors;
  if (list.empty()) return "";
  constexpr std::size_t kMaxRows = 10;
  std::vector<std::size_t> order(list.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return list[a].trajectories > list[b].trajectories;
  });
  const bool has_peak = !std::isnan(list.front().peak);
  std::string text = fmt::format("{:<9}  {:<14}  {:>6}  {:>10}", "attractor", "motion", "period",
                                 result.study.model->states.front().name + "_rms");
  if (has_peak) text += fmt::format("  {:>10}", name_of_peak(*result.study.model));
  const bool has_impacts = have_impacts(list);
  if (has_impacts) text += fmt::format("  {:>8}", "impacts");
  text += fmt::format("  {:>12}  {:>7}\n", "lyapunov_max", "share");
  for (std::size_t i = 0; i < std::min(kMaxRows, order.size()); ++i) {
    const Attractor& attractor = list[order[i]];
    text += fmt::format(
        "{:>9}  {:<14}  {:>6}  {:>10.6g}", order[i] + 1, motion_names().at(attractor.motion),
        attractor.period > 0.0 ? fmt::format("{}", attractor.period) : "-", attractor.rms);
    if (has_peak) text += fmt::format("  {:>10.6g}", attractor.peak);
    if (has_impacts) {
      text += fmt::format("  {:>8}", attractor.impacts.empty() ? "-" : attractor.impacts);
    }
    text += fmt::format("  {:>12.4f}  {:>5.1f} %\n", attractor.exponent,
                        100.0 * share_of(attractor, result));
  }
  if (order.size() > kMaxRows) {
    text += fmt::format("... and {} more; the file lists them all\n", order.size() - kMaxRows);
  }
  if (result.uncertain > 0) {
    text += fmt::format(
        "{} trajectories lie between two attractors and may be of either: a longer settle or "
        "record "
        "tells\n",
        result.uncertain);
  }
  return text;
}

nlohmann::json attractors_as_json(const SweepResult& result) {
  nlohmann::json json = nlohmann::json::array();
  for (const Attractor& attractor : result.attractors) {
    nlohmann::json entry = {
        {"number", json.size() + 1},          {"motion_class", motion_names().at(attractor.motion)},
        {"period", attractor.period},         {"rms", attractor.rms},
        {"lyapunov_max", attractor.exponent}, {"share", share_of(attractor, result)}};
    if (!std::isnan(attractor.peak)) entry[name_of_peak(*result.study.model)] = attractor.peak;
    if (!attractor.impacts.empty()) entry["impacts"] = attractor.impacts;
    json.push_back(entry);
  }
  return json;
}

}  // namespace gearsweep
