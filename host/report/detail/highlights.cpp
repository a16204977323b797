#include "report/detail/highlights.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "gear/drawing_keys.hpp"
#include "report/detail/html.hpp"
#include "report/detail/names.hpp"
#include "report/detail/speeds.hpp"
#include "report/detail/words.hpp"
#include "result/peaks.hpp"

namespace gearsweep {
namespace {

std::vector<std::string> files_over_speed(const ReportFindings& findings) {
  if (!findings.has_directions) return {"line.nc"};
  return {"line.nc", "up.nc", "down.nc"};
}

std::string run_html(const std::string& file) {
  return file == "up.nc" ? " on run-up" : file == "down.nc" ? " on run-down" : "";
}

std::string speed_at(const ReportFindings& findings, std::size_t point) {
  return speed_html(findings, findings.orders.forcing[point]);
}

// "the largest meshing force is 1.93 times the mean load". HTML.
std::string force_html(const ReportFindings& findings, const std::string& file, std::size_t point) {
  const double factor = findings.load_factor.empty()
                            ? std::nan("")
                            : findings.over_speed(file, findings.load_factor).values[point];
  if (std::isfinite(factor)) {
    if (!findings.mesh.empty()) {
      return fmt::format("the largest {} is {:.3g} times its mean load", html_text(findings.mesh),
                         factor);
    }
    return fmt::format("the largest force between the teeth is {:.3g} times the mean load", factor);
  }
  const ResultMap force = findings.over_speed(file, findings.force);
  const std::string unit = html_unit(force.unit);
  return fmt::format("{} is {}{}", html_text(force.name), html_number(force.values[point]),
                     unit.empty() ? "" : " " + unit);
}

bool is_on_back_flank(const ReportFindings& findings, const std::string& file, std::size_t point) {
  if (std::ranges::find(findings.quantities, "contact_class") == findings.quantities.end()) {
    return false;
  }
  const ResultMap contact = findings.over_speed(file, "contact_class");
  const auto both = std::ranges::find(contact.flags, "double_sided");
  return both != contact.flags.end() &&
         contact.values[point] == static_cast<double>(both - contact.flags.begin());
}

// Names the mesh whose teeth are apart longest, where there are several: "the second mesh".
std::string contact_apart_html(const ReportFindings& findings, const std::string& file,
                               std::size_t point) {
  const auto share = [&](const std::string& quantity) {
    const double value = findings.over_speed(file, quantity).values[point];
    return std::isnan(value) ? 0.0 : value;
  };
  const auto longest = std::ranges::max_element(findings.apart, {}, share);
  return html_text(contact_words(*findings.study.model,
                                 longest->substr(0, longest->find("_contact_gap")),
                                 findings.count_of(*longest)));
}

// ", and the teeth lose contact for 23 % of the time". HTML; empty without a contact.
std::string contact_html(const ReportFindings& findings, const std::string& file,
                         std::size_t point) {
  const std::vector<double> apart = time_apart(findings, file);
  if (apart.empty() || std::isnan(apart[point])) return "";
  const bool has_several = findings.apart.size() > 1;
  if (apart[point] <= 0.0) {
    return has_several ? ", and the teeth of all meshes stay in contact"
                       : ", and the teeth stay in contact";
  }
  return fmt::format(", and the teeth{} lose contact: they are apart for {} of the time{}",
                     has_several ? " of " + contact_apart_html(findings, file, point) : "",
                     html_percent(apart[point]),
                     is_on_back_flank(findings, file, point) ? " and hit the back flank, too" : "");
}

std::string next_critical_html(const ReportFindings& findings, double forcing) {
  const std::optional<CriticalSpeed> next = next_critical(findings, forcing, kNearSpeeds);
  if (!next) return "above it there is no critical speed";
  return fmt::format("the next critical speed, {} ({}), is {}", speed_html(findings, next->forcing),
                     next->html(findings), margin_html(*next, forcing));
}

// The nearest of the speeds to a mesh frequency.
std::size_t nearest_point(const ReportFindings& findings, double forcing) {
  const std::vector<double>& all = findings.orders.forcing;
  const auto nearest =
      std::ranges::min_element(all, {}, [&](double own) { return std::abs(own - forcing); });
  return static_cast<std::size_t>(nearest - all.begin());
}

// What holds at the speed in use; empty where the drawing does not say it.
std::string use_html(const ReportFindings& findings) {
  const std::optional<double> used = used_forcing(findings);
  if (!used) return "";
  const std::string speed = speed_html(findings, *used);
  const auto [slowest, fastest] = std::ranges::minmax_element(findings.orders.forcing);
  if (*used < *slowest || *used > *fastest) {
    return fmt::format("The speed in use, {}, is not among the speeds of this report.", speed);
  }
  const std::size_t point = nearest_point(findings, *used);
  std::string text =
      fmt::format("At the speed in use, {}, {}{}", speed, force_html(findings, "line.nc", point),
                  contact_html(findings, "line.nc", point));
  if (const std::optional<CriticalSpeed> nearest = nearest_critical(findings, *used, false)) {
    text += fmt::format("; the nearest critical speed, {} ({}), is {}",
                        speed_html(findings, nearest->forcing), nearest->html(findings),
                        margin_html(*nearest, *used));
  }
  return text + ".";
}

// Where in the sweep teeth part. Empty without a contact.
std::string range_of_loss_html(const ReportFindings& findings) {
  const std::vector<double> apart = time_apart(findings, "line.nc");
  if (apart.empty()) return "";
  std::vector<double> lost;
  for (std::size_t point = 0; point < apart.size(); ++point) {
    if (apart[point] > 0.0) lost.push_back(findings.orders.forcing[point]);
  }
  if (lost.empty()) return fmt::format("The teeth stay in contact at all {} speeds.", apart.size());
  const auto [slowest, fastest] = std::ranges::minmax_element(lost);
  const double most = apart[*largest_of(apart)];
  return fmt::format(
      "Contact is lost at {} of {} speeds, the slowest {}, the fastest {}; the teeth are apart for "
      "at most {} of the time.",
      lost.size(), apart.size(), speed_html(findings, *slowest), speed_html(findings, *fastest),
      html_percent(most));
}

// A larger force than at the worst speed, where that is the one of the strongest vibration.
std::string larger_force_html(const ReportFindings& findings, const WorstSpeed& worst) {
  constexpr double kClearly = 1.05;
  const std::string& quantity =
      findings.load_factor.empty() ? findings.force : findings.load_factor;
  const double own = findings.over_speed(worst.file, quantity).values[worst.point];
  const ResultMap map = findings.over_speed("line.nc", quantity);
  const std::optional<std::size_t> largest = largest_of(map.values);
  if (!largest || !(map.values[*largest] > kClearly * own)) return "";
  return fmt::format("The force vibrates most at the worst speed; it is largest at {}: {}.",
                     speed_at(findings, *largest), force_html(findings, "line.nc", *largest));
}

// What the other meshes have, each at its worst speed. Of more than a few the largest of them.
std::string other_meshes_html(const ReportFindings& findings) {
  constexpr std::size_t kMany = 3;
  struct OtherMesh {
    std::string words;
    double factor;
    std::size_t point;
  };
  std::vector<OtherMesh> others;
  for (const ChannelInfo& force : findings.study.model->signals_of(Role::mesh_force)) {
    const std::string factor = load_factor_of(*findings.study.model, force);
    const bool is_known =
        std::ranges::find(findings.quantities, factor) != findings.quantities.end();
    if (findings.mesh.empty() || factor == findings.load_factor || !is_known) continue;
    const ResultMap map = findings.over_speed("line.nc", factor);
    const std::optional<std::size_t> point = largest_of(map.values);
    if (point)
      others.push_back({force_words(force, findings.count_of(factor)), map.values[*point], *point});
  }
  std::ranges::sort(others, std::ranges::greater(), &OtherMesh::factor);
  if (others.size() >= kMany) others.resize(1);
  std::string text;
  for (const OtherMesh& one : others) {
    text += fmt::format("{}The largest {} is at most {:.3g} times its mean load, at {}.",
                        text.empty() ? "" : " ", html_text(one.words), one.factor,
                        speed_at(findings, one.point));
  }
  return text;
}

std::string missing_html(const ReportFindings& findings) {
  const ResultMap force = findings.over_speed("line.nc", findings.force);
  const auto missing =
      std::ranges::count_if(force.values, [](double value) { return !std::isfinite(value); });
  if (missing == 0) return "";
  return fmt::format("At {} of {} speeds there is no value: the motion diverged.", missing,
                     force.values.size());
}

// How many numbers of the drawing nobody gave, and how many parameters beside it.
std::string estimates_html(const ReportFindings& findings) {
  const auto drawn =
      std::ranges::count(findings.given.gear_data, DatumOrigin::estimated, &GearDatum::origin);
  const auto beside = std::ranges::count_if(
      findings.given.parameter_origins,
      [](const std::string& origin) { return origin.starts_with(kEstimatedOrigin); });
  if (drawn + beside == 0) return "";
  return fmt::format("{} of the {} {}: the last table says which.", drawn + beside,
                     beside == 0 ? "drawing's numbers" : "given numbers",
                     drawn + beside == 1 ? "is an estimate" : "are estimates");
}

}  // namespace

std::optional<std::size_t> largest_of(const std::vector<double>& values) {
  std::optional<std::size_t> largest;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::isfinite(values[i]) && (!largest || values[i] > values[*largest])) largest = i;
  }
  return largest;
}

std::optional<WorstSpeed> find_worst(const ReportFindings& findings) {
  constexpr double kClearly = 1.02;
  std::optional<WorstSpeed> worst;
  for (const std::string& file : files_over_speed(findings)) {
    PeakSearch search;
    search.count = 1;
    for (const Peak& peak : find_peaks(findings.over_speed(file, findings.ranking), search)) {
      if (worst && peak.value <= kClearly * worst->value) continue;
      worst = {file, peak.point, peak.value, peak.at_edge};
    }
  }
  return worst;
}

std::vector<double> time_apart(const ReportFindings& findings, const std::string& file) {
  std::vector<double> apart;
  for (const std::string& quantity : findings.apart) {
    const ResultMap map = findings.over_speed(file, quantity);
    if (apart.empty()) apart = map.values;
    for (std::size_t point = 0; point < apart.size(); ++point) {
      apart[point] = std::max(apart[point], map.values[point]);
    }
  }
  return apart;
}

std::optional<double> used_forcing(const ReportFindings& findings) {
  const Study& study = findings.given;
  const auto speed = std::ranges::find(study.gear_data, kSpeed.name, &GearDatum::key);
  const auto is_speed = [](const Axis& axis) { return axis.name.starts_with(kSpeed.name); };
  const bool is_swept = std::ranges::any_of(study.axes, is_speed);
  if (speed == study.gear_data.end() || is_swept || !findings.is_si()) return std::nullopt;
  return std::stod(speed->value) / study.scales.rpm_per_omega;
}

std::string answer_html(const ReportFindings& findings) {
  const std::optional<WorstSpeed> worst = find_worst(findings);
  if (!worst) return "No speed has a motion that stays finite.";
  return fmt::format("The worst speed is {}{}: {}{}; {}.", speed_at(findings, worst->point),
                     run_html(worst->file), force_html(findings, worst->file, worst->point),
                     contact_html(findings, worst->file, worst->point),
                     next_critical_html(findings, findings.orders.forcing[worst->point]));
}

std::vector<std::string> remarks_html(const ReportFindings& findings) {
  std::vector<std::string> remarks = {use_html(findings), missing_html(findings)};
  if (const std::optional<WorstSpeed> worst = find_worst(findings)) {
    remarks.push_back(other_meshes_html(findings));
    remarks.push_back(range_of_loss_html(findings));
    remarks.push_back(larger_force_html(findings, *worst));
    if (worst->is_edge) {
      remarks.emplace_back(
          "The sweep ends at its worst speed: beyond it there may be a worse one.");
    }
  }
  remarks.push_back(estimates_html(findings));
  std::erase(remarks, "");
  return remarks.empty() ? remarks : std::vector{fmt::format("{}", fmt::join(remarks, " "))};
}

}  // namespace gearsweep
