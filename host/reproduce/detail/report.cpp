#include "reproduce/detail/report.hpp"

#include <fmt/format.h>

#include <cmath>

#include "reproduce/detail/claims.hpp"

namespace gearsweep {
namespace {

// Points of two maps of one quantity that differ by more than `margin`, as a share of all.
double differing(const SweepResult& a, const SweepResult& b, const std::string& quantity,
                 double margin) {
  const MapCurve first(a, quantity), second(b, quantity);
  return share_of(first.within(-HUGE_VAL, HUGE_VAL), [&](std::size_t i) {
    return !(std::abs(first[i] - second[i]) <= margin * std::abs(first[i]));
  });
}

std::string introduction(const MeasuredFigures& measured) {
  const bool is_paper = measured.preset == "paper";
  return fmt::format(
      "# Figures 4 to 11 of Chen et al. 2011, preset `{}`\n\n"
      "Chen Siyu, Tang Jinyuan, Luo Caiwang, Wang Qibo, Nonlinear dynamic characteristics of "
      "geared "
      "rotor bearing systems with dynamic backlash and friction, Mechanism and Machine Theory 46 "
      "(2011) 466-478.\n\n{}{}\n\n",
      measured.preset,
      is_paper
          ? "The printed equations with parameters fitted to the figures, since the paper does not "
            "state all of them; each run starts at zero, the first 600 periods are discarded."
          : "The same questions to the consistent equations, in which the shafts act on the mesh "
            "with the sign that the geometry asks for, with the parameters of a steel pair. The "
            "paper's numbers belong to other parameters: a claim that does not hold here need not "
            "be wrong there.",
      measured.overrides.empty() ? ""
                                 : fmt::format(" In place of the preset's values: `{}`.",
                                               fmt::join(measured.overrides, "`, `")));
}

std::string claims_table(const std::vector<Judgement>& judgements) {
  std::string text =
      "## Claims\n\n| figure | what the paper says | holds if | measured | verdict |\n"
      "| --- | --- | --- | --- | --- |\n";
  for (const Judgement& judgement : judgements) {
    text += fmt::format("| {} | {} | {} | {} | **{}** |\n", judgement.figure, judgement.claim,
                        judgement.rule, judgement.measured, name_of(judgement.verdict));
  }
  return text + "\n";
}

// The pictures of basins beside the table of jumps.
std::string describe_basins(const MeasuredFigures& measured) {
  std::string text =
      "The pictures of the basins show a plane of the ten-dimensional space of initial states: x1 "
      "and v1 vary, the shafts start at rest in their places. The 16 states of the table vary in "
      "all ten, by up to 1. What is reached from displaced or moving shafts alone counts in the "
      "table and is in no picture; 16 states may miss what 2501 reach";
  for (const MeasuredFigures::Basins& basins : measured.basins) {
    text += fmt::format("; figure {}, b = {:.4f}: {} in the picture, {} in the table",
                        basins.figure.substr(3), basins.b, basins.shown, basins.counted);
  }
  return text + ".\n\n";
}

std::string beyond(const MeasuredFigures& measured) {
  std::string text = "## Beyond the paper\n\n";
  text += describe_jumps(measured);
  const double hysteresis = differing(measured.maps.at("fig9-forward"),
                                      measured.maps.at("fig9-backward"), "x1_rms", 0.01);
  text += fmt::format(
      "- **Sweeping omega forward and backward** at b = 1, each point from its neighbour's last "
      "state: the RMS "
      "differs by more than 1 % at {:.0f} % of the frequencies: there two motions coexist, or "
      "chaos does "
      "not come to the same average.\n",
      100.0 * hysteresis);
  text += fmt::format(
      "- **Energy**, undamped, unforced, without friction, in contact, over three periods: "
      "`consistent` changes it by {:.1e} (the steps), `printed` by {:.1e}.\n",
      measured.drift_consistent, measured.drift_printed);
  const SweepResult& constant = measured.maps.at("omega-b-constant");
  const SweepResult& dynamic = measured.maps.at("omega-b-dynamic");
  const auto chaotic = [](const SweepResult& result) {
    std::size_t count = 0;
    for (const double exponent : result.values.front()) count += exponent > 0.003 ? 1 : 0;
    return 100.0 * static_cast<double>(count) / static_cast<double>(result.status.size());
  };
  text += fmt::format(
      "- **omega x b**: {:.1f} % of the points are chaotic (exponent above 0.003) with constant, "
      "{:.1f} % with dynamic backlash.\n\n",
      chaotic(constant), chaotic(dynamic));
  return text;
}

}  // namespace

std::string describe_jumps(const MeasuredFigures& measured) {
  if (measured.jumps.empty()) {
    return "No jump: the largest meshing force stays below 0.6 over all of figures 7 and 10.\n\n";
  }
  std::string text =
      "Where the largest meshing force passes 0.6 from one half backlash to the next, and how many "
      "attractors 16 initial states around rest reach on both sides: with two or more on both, "
      "both motions exist on both sides, and the jump is a change of basin, not a bifurcation. "
      "They are told apart by the boxes around 200 sections of each, so that one chaotic motion "
      "may "
      "count as two.\n\n"
      "| figure | from b | to b | attractors at the one | at the other | |\n"
      "| --- | --- | --- | --- | --- | --- |\n";
  for (const auto& [figure, jumps] : measured.jumps) {
    for (const MeasuredFigures::Jump& jump : jumps) {
      text += fmt::format("| {} | {:.4f} | {:.4f} | {} | {} | {} |\n", figure.substr(3), jump.below,
                          jump.above, jump.count_below, jump.count_above,
                          jump.is_change_of_basin() ? "change of basin" : "may be a bifurcation");
    }
  }
  return text + "\n" + describe_basins(measured);
}

std::string report_on(const MeasuredFigures& measured) {
  return introduction(measured) + claims_table(judge(measured)) + beyond(measured);
}

}  // namespace gearsweep
