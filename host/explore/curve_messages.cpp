#include "explore/curve_messages.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "explore/detail/message_parts.hpp"
#include "plot/curve_styles.hpp"

namespace gearsweep {
namespace {

using nlohmann::json;

bool has_kind(const StoredCurves& stored, const std::string& kind) {
  return std::ranges::find(stored.curves, kind, &StoredCurve::kind) != stored.curves.end();
}

json curve_as_json(const StoredCurve& curve) {
  json x = json::array(), y = json::array(), stretches = json::array();
  for (const auto& [across, up] : curve.places) {
    x.push_back(across);
    y.push_back(up);
  }
  for (const CurveStretch& stretch : stretches_of(curve)) {
    stretches.push_back({stretch.first, stretch.last, stretch.is_stable});
  }
  return {{"kind", curve.kind},
          {"period", curve.period},
          {"x", std::move(x)},
          {"y", std::move(y)},
          {"stretches", std::move(stretches)}};
}

// All digits: as it stands in the file.
std::string digits(double value) {
  return std::isfinite(value) ? fmt::format("{}", value) : "not known";
}

// "-1", "0.25+0.5i"; enough digits to see how near to the unit circle it is.
std::string multiplier_text(const std::complex<double>& multiplier) {
  if (!std::isfinite(multiplier.real()) || !std::isfinite(multiplier.imag())) return "not known";
  const std::string real = fmt::format("{:.8g}", multiplier.real());
  if (multiplier.imag() == 0.0) return real;
  return fmt::format("{}{:+.8g}i", real, multiplier.imag());
}

std::string multipliers_text(const std::vector<std::complex<double>>& multipliers) {
  std::string text;
  for (const std::complex<double>& multiplier : multipliers) {
    text += (text.empty() ? "" : ", ") + multiplier_text(multiplier);
  }
  return text;
}

std::string periods_text(int period) {
  return fmt::format("{} {} of the forcing", period, period == 1 ? "period" : "periods");
}

json facts_of(const StoredCurve& curve, std::size_t point) {
  const StoredOrbit& orbit = curve.orbits[point];
  json facts = json::array();
  const auto add = [&](const char* name, const std::string& text) {
    facts.push_back({{"name", name}, {"value", nullptr}, {"text", text}});
  };
  add("bifurcation", curve.kind);
  if (!curve.limit.empty()) add("the orbit", curve.limit);
  add("period", periods_text(curve.period));
  add("stable", curve.is_stable[point] ? "yes: a stable motion bifurcates here"
                                       : "no: another multiplier is outside the unit circle");
  add("multipliers", multipliers_text(orbit.multipliers));
  add("angle", digits(orbit.angle) + " rad");
  add("residual", digits(orbit.residual));
  add("error of steps", std::isfinite(curve.step_error)
                            ? fmt::format("{:.2g} pixels of its map", curve.step_error)
                            : "not known");
  return facts;
}

json multipliers_of(const StoredCurve& curve, std::size_t point) {
  json values = json::array();
  for (const std::complex<double>& multiplier : curve.orbits[point].multipliers) {
    values.push_back({number_or_null(multiplier.real()), number_or_null(multiplier.imag())});
  }
  return {{"values", std::move(values)},
          {"stable", bool{curve.is_stable[point]}},
          {"period", curve.period},
          {"text", fmt::format("{} of period {}, from the file", curve.kind, curve.period)}};
}

std::string gap_note(const BorderMotion& border, int period) {
  return fmt::format(
      "The motion begins at the file's state. After {} it is {:.1g} of its range from there.",
      periods_text(period), border.gap);
}

// The same turn, with the same steps.
std::string trace_command(const Explorer& explorer, const Scene& scene,
                          const BorderMotion& border) {
  std::vector<NamedValue> sets = scene.changes().sets;
  for (const NamedValue& state : border.start) {
    std::erase_if(sets, [&](const NamedValue& set) { return set.name == state.name; });
    sets.push_back(state);
  }
  return fmt::format(
      "gearsweep trace {}{} --set integrate.steps_per_period={} --at {} --settle 0 --record {} -o "
      "orbit.nc",
      explorer.source(), sets_text(explorer, sets), border.motion.study.integrate.steps_per_period,
      at_text(explorer, scene, border.motion.at), border.turn);
}

}  // namespace

std::string curves_message(const ExploredCurves& curves) {
  const StoredCurves& stored = curves.stored;
  json styles = json::array(), all = json::array();
  for (const CurveStyle& style : kCurveStyles) {
    if (!has_kind(stored, style.kind)) continue;
    styles.push_back(
        {{"kind", style.kind}, {"colour", style.colour}, {"dashes", dash_lengths(style)}});
  }
  for (const StoredCurve& curve : stored.curves) all.push_back(curve_as_json(curve));
  return dumped({{"x", stored.x},
                 {"y", stored.y},
                 {"width", kCurveWidth},
                 {"rim", kCurveRimWidth},
                 {"thin", kThinCurveWidth},
                 {"styles", std::move(styles)},
                 {"curves", std::move(all)}});
}

std::string border_message(const Explorer& explorer, const Scene& scene,
                           const BorderMotion& border) {
  const StoredCurve& curve = explorer.curves()->stored.curves[border.place.curve];
  const Motion& motion = border.motion;
  json message = {{"label", fmt::format("{} of period {} at {}", curve.kind, curve.period,
                                        label_of(*motion.study.model,
                                                 find_place(motion.study, motion.at, "")))},
                  {"status", "ok"},
                  {"values", facts_of(curve, border.place.point)},
                  {"commands", json::array()},
                  {"multipliers", multipliers_of(curve, border.place.point)},
                  {"is_border", true}};
  add_motion(motion, &message);
  if (motion.trace) {
    message["notes"].push_back(gap_note(border, curve.period));
    if (!explorer.is_model()) {
      message["commands"].push_back(trace_command(explorer, scene, border));
    }
  }
  return dumped(message);
}

}  // namespace gearsweep
