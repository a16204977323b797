#include "cli/floquet_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace gearsweep {
namespace {

// The bifurcations of all branches by the parameter's value.
std::vector<LocatedBifurcation> sorted_bifurcations(const FloquetFindings& findings) {
  std::vector<LocatedBifurcation> all;
  for (const Branch& branch : findings.branches) {
    all.insert(all.end(), branch.bifurcations.begin(), branch.bifurcations.end());
  }
  std::sort(all.begin(), all.end(),
            [](const auto& a, const auto& b) { return a.parameter < b.parameter; });
  return all;
}

// A crossing at +1 is a fold or a branching; one orbit does not tell which.
std::string nearest_name(const Nearest& nearest) {
  if (nearest.kind != Bifurcation::fold) return name_of(nearest.kind);
  return "fold or symmetry breaking";
}

std::string describe_orbit(const FloquetFindings& findings) {
  std::string text;
  const Orbit& orbit = findings.orbit;
  const Model& model = *findings.study.model;
  std::vector<std::string> place;
  for (const Axis& axis : findings.study.axes) {
    place.push_back(fmt::format("{} = {:.10g}", axis.name, axis.values.front()));
  }
  text += fmt::format("{} at {}\n", model.name, fmt::join(place, ", "));
  text +=
      fmt::format("orbit of period {} ({}), T = {:.10g}\n", orbit.period,
                  orbit.stable() ? "stable"
                                 : fmt::format("unstable, {} of {} multipliers outside",
                                               orbit.unstable_count(), orbit.multipliers.size()),
                  static_cast<double>(orbit.period) * findings.map.period());
  for (std::size_t i = 0; i < model.states.size(); ++i) {
    text += fmt::format("  {:<4} {:.12g}\n", model.states[i].name,
                        orbit.state[static_cast<Eigen::Index>(i)]);
  }
  text += fmt::format("multipliers (modulus, real and imaginary part)\n");
  for (const std::complex<double>& m : orbit.multipliers) {
    text += fmt::format("  {:<14.8g} {:.8g} {:+.8g}i\n", std::abs(m), m.real(), m.imag());
  }
  const Nearest nearest = nearest_bifurcation(orbit);
  text += fmt::format("nearest bifurcation: {} (modulus {:.8g}, {:.3g} {} the unit circle)\n",
                      nearest_name(nearest), std::abs(nearest.multiplier), std::abs(nearest.margin),
                      nearest.margin >= 0.0 ? "inside" : "outside");
  return text;
}

std::string describe_branches(const FloquetFindings& findings) {
  std::string text;
  if (!findings.range) return text;
  const std::string& name = findings.study.model->parameters[findings.range->parameter].name;
  text += fmt::format("along {} = {} .. {}\n", name, findings.range->from, findings.range->to);
  for (const LocatedBifurcation& found : sorted_bifurcations(findings)) {
    text += fmt::format("  {:<18} {} = {:.10g}{}\n", name_of(found.kind), name, found.parameter,
                        found.born_of > 0
                            ? fmt::format(" (this branch begins, out of period {})", found.born_of)
                            : "");
  }
  for (const Branch& branch : findings.branches) {
    text += fmt::format("  {} orbits; {}\n", branch.orbits.size(), branch.ended);
  }
  return text;
}

nlohmann::json json_of(const Orbit& orbit) {
  nlohmann::json json = {{"period", orbit.period}, {"stable", orbit.stable()}};
  json["state"] = std::vector<double>(orbit.state.begin(), orbit.state.end());
  for (const std::complex<double>& m : orbit.multipliers) {
    json["multipliers"].push_back({{"re", m.real()}, {"im", m.imag()}, {"abs", std::abs(m)}});
  }
  return json;
}

}  // namespace

std::string describe_floquet(const FloquetFindings& findings) {
  return describe_orbit(findings) + describe_branches(findings);
}

std::string floquet_as_json(const FloquetFindings& findings) {
  const Model& model = *findings.study.model;
  nlohmann::json json = json_of(findings.orbit);
  for (const ChannelInfo& state : model.states) json["states"].push_back(state.name);
  for (std::size_t i = 0; i < model.parameters.size(); ++i) {
    json["parameters"][model.parameters[i].name] = findings.study.setting.parameters[i];
  }
  const Nearest nearest = nearest_bifurcation(findings.orbit);
  json["nearest"] = {{"kind", nearest_name(nearest)}, {"margin", nearest.margin}};
  if (findings.range) {
    json["along"] = model.parameters[findings.range->parameter].name;
    json["bifurcations"] = nlohmann::json::array();
    for (const LocatedBifurcation& found : sorted_bifurcations(findings)) {
      nlohmann::json entry = json_of(found.orbit);
      entry["kind"] = name_of(found.kind);
      entry["value"] = found.parameter;
      entry["born_of"] = found.born_of;
      json["bifurcations"].push_back(entry);
    }
    for (const Branch& branch : findings.branches) {
      nlohmann::json entry = {{"ended", branch.ended}};
      for (const BranchOrbit& member : branch.orbits) {
        entry["orbits"].push_back(json_of(member.orbit));
        entry["orbits"].back()["value"] = member.parameter;
      }
      json["branches"].push_back(entry);
    }
  }
  return json.dump(2) + "\n";
}

}  // namespace gearsweep
