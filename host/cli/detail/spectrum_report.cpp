#include "cli/detail/spectrum_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "result/load_spectrum.hpp"
#include "result/si_units.hpp"

namespace gearsweep {
namespace {

// "points 2, 5 and 7 others".
std::string named_points(const std::vector<std::size_t>& points) {
  constexpr std::size_t kShown = 5;
  std::vector<std::size_t> numbers;
  for (const std::size_t point : points) {
    if (numbers.size() < kShown) numbers.push_back(point + 1);
  }
  const std::string text =
      fmt::format("{} {}", points.size() == 1 ? "point" : "points", fmt::join(numbers, ", "));
  return points.size() <= kShown
             ? text
             : fmt::format("{} and {} others", text, points.size() - numbers.size());
}

// A force in the model's unit: "0.0912 = 81.4 N m", of a drawing "812 N = 81.4 N m".
std::string force_text(const Study& study, const SpectrumForce& force, double value) {
  const std::string& unit = study.model->parameters[force.load].unit;
  const SiUnit si = study.scales.known() ? si_unit(unit, study.scales) : SiUnit{};
  std::string text = si.scale > 0.0 ? fmt::format("{:.4g} {}", si.scale * value, si.name)
                                    : fmt::format("{:.4g} {}", value, unit);
  if (const std::optional<double> torque = torque_per_load(study, force)) {
    text += fmt::format(" ({:.4g} N m)", *torque * value);
  }
  return text;
}

std::string describe_force(const Study& study, const SpectrumForce& force) {
  if (std::isnan(force.mean_factor)) {
    return fmt::format("  {}: unknown, since a load that lasts has none\n", force.factor);
  }
  const auto worst = std::ranges::max_element(force.damage) - force.damage.begin();
  return fmt::format(
      "  {}: {:.4g} on average over the time under load, {:.4g} at most (point {})\n"
      "  equivalent load: {}; of the largest forces: {}\n"
      "    by Miner's rule with the slope {:g} (ISO 6336-6); {:.3g} % of the damage "
      "is done under point {}\n",
      force.factor, force.mean_factor, force.max_factor, force.max_point + 1,
      force_text(study, force, force.equivalent_load),
      force_text(study, force, force.equivalent_force), study.spectrum->slope,
      100.0 * force.damage[static_cast<std::size_t>(worst)], worst + 1);
}

}  // namespace

std::string describe_spectrum(const SweepResult& result) {
  const Study& study = result.study;
  if (!study.spectrum) return "";
  const SpectrumAnswers answers = spectrum_answers(result);
  std::string text = fmt::format("load spectrum of {} points:\n", study.points());
  for (const SpectrumForce& force : answers.forces) text += describe_force(study, force);
  if (answers.forces.empty()) {
    text +=
        "  no load factor is among the quantities of the study, so there is no equivalent load\n";
  }
  if (answers.parting_share) {
    text += std::isnan(*answers.parting_share)
                ? "  whether teeth part is unknown for some of the time\n"
                : fmt::format("  teeth part under loads that last {:.4g} % of the time{}\n",
                              100.0 * *answers.parting_share,
                              answers.parting.empty()
                                  ? ""
                                  : fmt::format(" ({})", named_points(answers.parting)));
  }
  if (!answers.failed.empty()) {
    text += fmt::format("  without values, so that what rests on them is unknown: {}\n",
                        named_points(answers.failed));
  }
  return text;
}

nlohmann::json spectrum_as_json(const SweepResult& result) {
  nlohmann::json json;
  if (!result.study.spectrum) return json;
  const SpectrumAnswers answers = spectrum_answers(result);
  json["slope"] = result.study.spectrum->slope;
  json["forces"] = nlohmann::json::object();
  for (const SpectrumForce& force : answers.forces) {
    nlohmann::json& own = json["forces"][force.factor];
    own["mean"] = force.mean_factor;
    own["max"] = force.max_factor;
    own["max_point"] = force.max_point + 1;
    own["equivalent_load"] = force.equivalent_load;
    own["equivalent_force"] = force.equivalent_force;
    if (const std::optional<double> torque = torque_per_load(result.study, force)) {
      own["equivalent_torque_N_m"] = *torque * force.equivalent_load;
      own["equivalent_force_torque_N_m"] = *torque * force.equivalent_force;
    }
    own["damage"] = force.damage;
  }
  if (answers.parting_share) json["parting_share"] = *answers.parting_share;
  return json;
}

}  // namespace gearsweep
