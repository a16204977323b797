#include "result/load_spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string_view>

#include "plan/study_points.hpp"

namespace gearsweep {
namespace {

constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();

// What a study's points have, as far as a spectrum counts it.
struct Loads {
  std::vector<double> cycles;  // [point] share of time times mesh frequency
  std::vector<ModelSetting> settings;
};

Loads loads_of(const Study& study) {
  const StudyPoints points(std::shared_ptr<const Study>(std::shared_ptr<void>(), &study));
  Loads loads;
  ModelSetting setting = study.setting;
  for (std::size_t point = 0; point < study.points(); ++point) {
    points.set(point, &setting);
    const double frequency = study.model->mesh_periods(setting) / study.model->period(setting);
    loads.cycles.push_back(study.spectrum->shares[point] * frequency);
    loads.settings.push_back(setting);
  }
  return loads;
}

// (sum n_i F_i^p / sum n_i)^(1/p), and what each load adds to that sum, as a share of it. A load of
// no cycles counts nothing, whatever it is.
double equivalent(const std::vector<double>& cycles, const std::vector<double>& forces,
                  double slope, std::vector<double>* shares) {
  double largest = 0.0, sum = 0.0, all = 0.0;
  for (std::size_t i = 0; i < cycles.size(); ++i) {
    if (cycles[i] > 0.0 && !(forces[i] <= largest)) largest = forces[i];
  }
  shares->assign(cycles.size(), 0.0);
  for (std::size_t i = 0; i < cycles.size(); ++i) {
    if (cycles[i] == 0.0) continue;
    all += cycles[i];
    if (largest == 0.0) continue;
    (*shares)[i] = cycles[i] * std::pow(forces[i] / largest, slope);
    sum += (*shares)[i];
  }
  for (double& share : *shares) share = sum == 0.0 ? share : share / sum;
  return largest * std::pow(sum / all, 1.0 / slope);
}

// The map of the largest force that a load factor is of; nullptr where the study has it not.
const std::vector<double>* force_map(const SweepResult& result, std::string_view factor) {
  const std::string_view ending = "dynamic_load_factor";
  const ChannelInfo* const only = result.study.model->contact_force();
  std::string force = only == nullptr ? "" : only->name;
  if (factor.size() > ending.size()) {
    force = std::string(factor.substr(0, factor.size() - ending.size() - 1));
  }
  const std::vector<Quantity>& quantities = result.study.selection.quantities;
  const auto found = std::ranges::find(quantities, force + "_max", &Quantity::name);
  return found == quantities.end()
             ? nullptr
             : &result.values[static_cast<std::size_t>(found - quantities.begin())];
}

SpectrumForce answer_of(const SweepResult& result, std::size_t quantity, const Loads& loads) {
  const Study& study = result.study;
  const Quantity& factor = study.selection.quantities[quantity];
  const std::vector<double>& factors = result.values[quantity];
  const std::vector<double>* const largest = force_map(result, factor.name);
  SpectrumForce out;
  out.factor = factor.name;
  out.load = *factor.divided_by;
  std::vector<double> means, forces;
  double time = 0.0, sum = 0.0;
  for (std::size_t point = 0; point < factors.size(); ++point) {
    const double share = study.spectrum->shares[point];
    const double load = loads.settings[point].parameters[out.load];
    means.push_back(std::abs(load));
    forces.push_back(largest != nullptr ? (*largest)[point] : factors[point] * load);
    if (share == 0.0 || load == 0.0) continue;
    time += share;
    sum += share * factors[point];
    // What is no number stays.
    if (std::isnan(out.max_factor) || factors[point] <= out.max_factor) continue;
    out.max_factor = factors[point];
    out.max_point = point;
  }
  out.mean_factor = time > 0.0 ? sum / time : kNoValue;
  if (time == 0.0) out.max_factor = kNoValue;
  out.equivalent_load = equivalent(loads.cycles, means, study.spectrum->slope, &out.damage);
  out.equivalent_force = equivalent(loads.cycles, forces, study.spectrum->slope, &out.damage);
  return out;
}

// Where teeth part: a class that is not the first, which is that of contact kept.
void take_parting(const SweepResult& result, SpectrumAnswers* out) {
  const std::vector<double>& shares = result.study.spectrum->shares;
  std::vector<bool> parts(shares.size(), false);
  double sum = 0.0;
  bool is_known = false;
  for (std::size_t i = 0; i < result.values.size(); ++i) {
    const Quantity& quantity = result.study.selection.quantities[i];
    if (!quantity.name.ends_with("contact_class") || quantity.flags.empty()) continue;
    is_known = true;
    for (std::size_t point = 0; point < parts.size(); ++point) {
      const double value = result.values[i][point];
      if (std::isnan(value) && shares[point] > 0.0) sum = kNoValue;
      if (value > 0.0) parts[point] = true;
    }
  }
  if (!is_known) return;
  for (std::size_t point = 0; point < parts.size(); ++point) {
    if (!parts[point] || shares[point] == 0.0) continue;
    sum += shares[point];
    out->parting.push_back(point);
  }
  out->parting_share = sum;
}

}  // namespace

SpectrumAnswers spectrum_answers(const SweepResult& result) {
  const Loads loads = loads_of(result.study);
  SpectrumAnswers answers;
  for (std::size_t i = 0; i < result.values.size(); ++i) {
    const Quantity& quantity = result.study.selection.quantities[i];
    if (quantity.divided_by && !quantity.of_draws) {
      answers.forces.push_back(answer_of(result, i, loads));
    }
  }
  take_parting(result, &answers);
  for (std::size_t point = 0; point < result.status.size(); ++point) {
    const bool lasts = result.study.spectrum->shares[point] > 0.0;
    if (lasts && !has_values(result.status[point])) answers.failed.push_back(point);
  }
  return answers;
}

std::optional<double> torque_per_load(const Study& study, const SpectrumForce& force) {
  const Axis& list = study.axes.front();
  const std::string& load = study.model->parameters[force.load].name;
  const Swept* const loads = list.find_column(load);
  if (loads == nullptr || loads->follows.find("torque_N_m") == std::string::npos) {
    return std::nullopt;
  }
  const std::size_t suffix = load.find('_');
  const Swept* const torques =
      list.find_column("torque_N_m" + (suffix == std::string::npos ? "" : load.substr(suffix)));
  for (std::size_t point = 0; torques != nullptr && point < loads->values.size(); ++point) {
    if (loads->values[point] > 0.0) return torques->values[point] / loads->values[point];
  }
  return std::nullopt;
}

}  // namespace gearsweep
