#include "cli/detail/floquet_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/detail/digits.hpp"
#include "orbits/returns.hpp"
#include "result/json_text.hpp"

namespace gearsweep {
namespace {

bool is_equilibrium(const Orbit& orbit) { return orbit.kind == OrbitKind::equilibrium; }

std::string describe_multipliers(const OrbitFindings& findings) {
  const Orbit& orbit = findings.orbit;
  std::string text =
      fmt::format("{} (modulus, real and imaginary part; the digits that hold)\n",
                  is_equilibrium(orbit) ? "eigenvalues, per unit of time" : "multipliers");
  for (Eigen::Index i = 0; i < orbit.multipliers.size(); ++i) {
    const std::complex<double>& m = orbit.multipliers[i];
    const double error = findings.error.multipliers[i];
    text += fmt::format("  {:<14} {} {}{}i\n", with_digits(std::abs(m), error),
                        with_digits(m.real(), error), m.imag() < 0.0 ? "-" : "+",
                        with_digits(std::fabs(m.imag()), error));
  }
  if (orbit.along) {
    text += fmt::format("and the one along the cycle, which is 1: off by {:.1g}\n",
                        std::fabs(*orbit.along - 1.0));
  }
  if (findings.error.grazing()) {
    text += fmt::format(
        "the motion grazes a limit of the backlash: it turns {:.1g} from it, nearer than it is "
        "known,\n"
        "and multipliers change like the root of that: few digits hold\n",
        *findings.error.graze_distance);
  } else if (!findings.error.state.allFinite()) {
    text +=
        "steps of twice the length find no such orbit, so no digit is sure: give more --steps\n";
  }
  return text;
}

// "real part -0.03".
std::string describe_real_part(const Nearest& nearest, double error) {
  const std::string part = with_digits(nearest.multiplier.real(), error);
  return part == "?" ? "no digit of its real part holds" : "real part " + part;
}

// "modulus 0.97, 0.03 inside the unit circle".
std::string describe_margin(const Nearest& nearest, double error) {
  const std::string modulus = with_digits(std::abs(nearest.multiplier), error);
  if (modulus == "?") return "no digit of its modulus holds";
  const double margin = std::fabs(nearest.margin);
  const std::string distance = with_digits(margin, std::max(error, 5e-4 * margin));
  if (distance.find_first_of("123456789") == std::string::npos) {
    return fmt::format("modulus {}: on the unit circle as far as digits hold", modulus);
  }
  return fmt::format("modulus {}, {} {} the unit circle", modulus, distance,
                     nearest.margin >= 0.0 ? "inside" : "outside");
}

std::string describe_stability(const Orbit& orbit, double error) {
  const std::optional<Nearest> nearest = nearest_bifurcation(orbit);
  if (nearest && orbit.kind != OrbitKind::forced && std::fabs(nearest->margin) <= error) {
    return "neutral as far as digits hold";
  }
  if (orbit.stable()) return "stable";
  return fmt::format(
      "unstable, {} of {} {}", orbit.unstable_count(), orbit.multipliers.size(),
      is_equilibrium(orbit) ? "eigenvalues with a positive real part" : "multipliers outside");
}

// "orbit of period 2 (stable), T = 12.56637061".
std::string describe_kind(const OrbitFindings& findings) {
  const Orbit& orbit = findings.orbit;
  const Model& model = *findings.study.model;
  const OrbitError& error = findings.error;
  const std::string stability =
      describe_stability(orbit, error.multipliers.size() > 0 ? error.multipliers.maxCoeff() : 0.0);
  switch (orbit.kind) {
    case OrbitKind::forced:
      return fmt::format("orbit of period {} ({}), T = {:.10g}\n", orbit.period, stability,
                         static_cast<double>(orbit.period) * findings.forcing_period);
    case OrbitKind::cycle:
      return fmt::format("cycle with {} ({}), T = {}\n", describe_returns(model, orbit.period),
                         stability, with_digits(orbit.duration, findings.error.duration));
    case OrbitKind::equilibrium:
      break;
  }
  return fmt::format("equilibrium ({})\n", stability);
}

std::string describe_nearest(const OrbitFindings& findings) {
  const std::optional<Nearest> nearest = nearest_bifurcation(findings.orbit);
  if (!nearest) return "";
  const double error = findings.error.multipliers.maxCoeff();
  if (std::abs(nearest->multiplier) <= error && !is_equilibrium(findings.orbit)) {
    // A multiplier that is 0 is far from any bifurcation, and its sign says nothing.
    return error < nearest->margin ? "" : "nearest bifurcation: unknown, as no multiplier is\n";
  }
  return fmt::format("nearest bifurcation: {} ({})\n", name_of(*nearest),
                     is_equilibrium(findings.orbit) ? describe_real_part(*nearest, error)
                                                    : describe_margin(*nearest, error));
}

std::string describe_orbit(const OrbitFindings& findings) {
  std::string text;
  const Orbit& orbit = findings.orbit;
  const Model& model = *findings.study.model;
  std::vector<std::string> place;
  for (const Axis& axis : findings.study.axes) {
    place.push_back(fmt::format("{} = {:.10g}", axis.name, axis.values.front()));
  }
  text += fmt::format("{} at {}\n", model.name, fmt::join(place, ", "));
  text += describe_kind(findings);
  for (Eigen::Index i = 0; i < orbit.state.size(); ++i) {
    text += fmt::format("  {:<4} {}\n", model.states[static_cast<std::size_t>(i)].name,
                        with_digits(orbit.state[i], findings.error.state[i]));
  }
  text += describe_multipliers(findings);
  text += describe_nearest(findings);
  return text;
}

std::string describe_birth(const LocatedBifurcation& found, OrbitKind kind) {
  if (kind != OrbitKind::forced) return " (this branch begins)";
  return fmt::format(" (this branch begins, out of period {})", found.born_of);
}

std::string count_of(std::size_t count, OrbitKind kind) {
  const bool rests = kind == OrbitKind::equilibrium;
  if (count == 1) return rests ? "1 equilibrium" : "1 orbit";
  return fmt::format("{} {}", count, rests ? "equilibria" : "orbits");
}

std::string value_text(const LocatedBifurcation& found) {
  return std::isfinite(found.error) ? with_digits(found.parameter, found.error)
                                    : fmt::format("about {:.3g}", found.parameter);
}

std::string describe_branch(const OrbitFindings& findings, const std::vector<Branch>& branches) {
  std::string text;
  const OrbitKind kind = findings.orbit.kind;
  const std::string& name = findings.study.model->parameters[findings.range->parameter].name;
  for (const LocatedBifurcation& found : bifurcations_of(branches)) {
    text += fmt::format("  {:<18} {} = {}{}{}\n", name_of(found.kind, kind), name,
                        value_text(found), found.born_of > 0 ? describe_birth(found, kind) : "",
                        found.grazing ? " (the motion grazes a limit of the backlash)" : "");
  }
  for (const Branch& branch : branches) {
    text += fmt::format("  {}; {}\n", count_of(branch.orbits.size(), kind), branch.ended);
  }
  return text;
}

// "branch 2, of period 4, leaves branch 1 at the flip at damping = 0.72986".
std::string describe_leaving(const OrbitFindings& findings, std::size_t number) {
  const LeavingBranch& leaving = findings.leaving[number - 1];
  const OrbitKind kind = findings.orbit.kind;
  const std::string length =
      kind == OrbitKind::forced ? fmt::format(", of period {},", leaving.period)
      : kind == OrbitKind::cycle
          ? fmt::format(", with {},", describe_returns(*findings.study.model, leaving.period))
          : "";
  return fmt::format("branch {}{} leaves {} at the {} at {} = {}\n{}", number, length,
                     leaving.parent == 0 ? "the first" : fmt::format("branch {}", leaving.parent),
                     name_of(leaving.origin.kind, kind),
                     findings.study.model->parameters[findings.range->parameter].name,
                     value_text(leaving.origin),
                     leaving.branches.empty() ? "  no orbit is found beside it\n"
                                              : describe_branch(findings, leaving.branches));
}

std::string describe_branches(const OrbitFindings& findings) {
  if (!findings.range) return "";
  const std::string& name = findings.study.model->parameters[findings.range->parameter].name;
  std::string text =
      fmt::format("along {} = {} .. {}\n", name, findings.range->from, findings.range->to);
  text += describe_branch(findings, findings.branches);
  for (std::size_t number = 1; number <= findings.leaving.size(); ++number) {
    text += describe_leaving(findings, number);
  }
  if (findings.leaving.size() == kMaxLeaving) {
    text += fmt::format("no more than {} branches are followed; a shorter range has fewer\n",
                        kMaxLeaving);
  }
  return text;
}

const char* spectrum_name(const Orbit& orbit) {
  return is_equilibrium(orbit) ? "eigenvalues" : "multipliers";
}

nlohmann::json json_of(const Orbit& orbit) {
  nlohmann::json json = {
      {"kind", name_of(orbit.kind)}, {"period", orbit.period}, {"stable", orbit.stable()}};
  json["state"] = std::vector<double>(orbit.state.begin(), orbit.state.end());
  nlohmann::json& spectrum = json[spectrum_name(orbit)] = nlohmann::json::array();
  for (const std::complex<double>& m : orbit.multipliers) {
    spectrum.push_back({{"re", m.real()}, {"im", m.imag()}, {"abs", std::abs(m)}});
  }
  if (orbit.kind == OrbitKind::cycle) json["cycle_time"] = orbit.duration;
  if (orbit.along) json["multiplier_along"] = *orbit.along;
  return json;
}

nlohmann::json json_of(const LocatedBifurcation& found, OrbitKind kind) {
  nlohmann::json entry = json_of(found.orbit);
  entry["kind"] = name_of(found.kind, kind);
  entry["value"] = found.parameter;
  entry["value_error"] = found.error;
  entry["grazing"] = found.grazing;
  entry["born_of"] = found.born_of;
  return entry;
}

void add_branches(const std::vector<Branch>& branches, OrbitKind kind, nlohmann::json* json) {
  (*json)["bifurcations"] = nlohmann::json::array();
  for (const LocatedBifurcation& found : bifurcations_of(branches)) {
    (*json)["bifurcations"].push_back(json_of(found, kind));
  }
  for (const Branch& branch : branches) {
    nlohmann::json entry = {{"ended", branch.ended}};
    for (const BranchOrbit& member : branch.orbits) {
      entry["orbits"].push_back(json_of(member.orbit));
      entry["orbits"].back()["value"] = member.parameter;
    }
    (*json)["branches"].push_back(entry);
  }
}

}  // namespace

std::string describe_floquet(const OrbitFindings& findings) {
  return describe_orbit(findings) + describe_branches(findings);
}

std::string floquet_as_json(const OrbitFindings& findings) {
  const Model& model = *findings.study.model;
  nlohmann::json json = json_of(findings.orbit);
  json["grazing"] = findings.error.grazing();
  json["state_error"] =
      std::vector<double>(findings.error.state.begin(), findings.error.state.end());
  nlohmann::json& spectrum = json[spectrum_name(findings.orbit)];
  for (std::size_t i = 0; i < spectrum.size(); ++i) {
    spectrum[i]["error"] = findings.error.multipliers[static_cast<Eigen::Index>(i)];
  }
  if (findings.orbit.kind == OrbitKind::cycle) json["cycle_time_error"] = findings.error.duration;
  for (const ChannelInfo& state : model.states) json["states"].push_back(state.name);
  for (std::size_t i = 0; i < model.parameters.size(); ++i) {
    json["parameters"][model.parameters[i].name] = findings.study.setting.parameters[i];
  }
  if (const std::optional<Nearest> nearest = nearest_bifurcation(findings.orbit)) {
    json["nearest"] = {{"kind", name_of(*nearest)}, {"margin", nearest->margin}};
  }
  if (findings.range) {
    json["along"] = model.parameters[findings.range->parameter].name;
    add_branches(findings.branches, findings.orbit.kind, &json);
    for (std::size_t i = 0; i < findings.leaving.size(); ++i) {
      const LeavingBranch& leaving = findings.leaving[i];
      nlohmann::json entry = {{"number", i + 1},
                              {"leaves", leaving.parent},
                              {"origin", json_of(leaving.origin, findings.orbit.kind)},
                              {"period", leaving.period}};
      add_branches(leaving.branches, findings.orbit.kind, &entry);
      json["leaving"].push_back(entry);
    }
  }
  return json_text(json);
}

}  // namespace gearsweep
