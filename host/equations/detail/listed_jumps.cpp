#include "equations/detail/listed_jumps.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "model/error.hpp"

namespace gearsweep {
namespace {

// Break phases closer than this are one (plan/phase_grid.cpp).
constexpr double kSamePhase = 1e-9;

double share_of(double phase) {
  const double share = phase / kWholePhase;
  return share - std::floor(share);
}

// In [0, 1): where the phase begins anew, and what the model's file lists.
std::vector<double> listed_phases(const Tapes& tapes, const ModelSetting& setting) {
  std::vector<double> listed(tapes.listed + 1), phases;
  tapes.jumps.run(inputs_of(tapes, setting).data(), listed.data() + 1);
  const std::size_t turns = turns_of(tapes, setting);
  for (std::size_t turn = 0; turn < turns; ++turn) {
    for (const double phase : listed) {
      phases.push_back((static_cast<double>(turn) + share_of(phase)) / static_cast<double>(turns));
    }
  }
  return phases;
}

std::vector<double> found_phases(const Tapes& tapes, const ModelSetting& setting) {
  try {
    std::vector<double> inputs = inputs_of(tapes, setting), phases;
    inputs.push_back(0.0);
    const std::size_t turns = turns_of(tapes, setting);
    const std::vector<std::vector<double>> found = tapes.breaks.find_in_turns(inputs, turns);
    for (std::size_t turn = 0; turn < turns; ++turn) {
      for (const double phase : found[turn]) {
        phases.push_back((static_cast<double>(turn) + share_of(phase)) /
                         static_cast<double>(turns));
      }
    }
    return phases;
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", tapes.file, error.what()));
  }
}

// phases: rising.
bool is_near(double phase, const std::vector<double>& phases) {
  if (phases.empty()) return false;
  const auto is_same = [&](double other) {
    const double distance = std::fabs(phase - other);
    return std::min(distance, 1.0 - distance) <= kSamePhase;
  };
  const auto after = std::ranges::lower_bound(phases, phase);
  return is_same(phases.front()) || is_same(phases.back()) ||
         (after != phases.end() && is_same(*after)) ||
         (after != phases.begin() && is_same(*(after - 1)));
}

// The breaks at which a coefficient has two values; breaks: rising, within (0, 1).
std::vector<double> jumps_among(const Tapes& tapes, const ModelSetting& setting,
                                const std::vector<double>& breaks) {
  constexpr double kRounding = 1e-9;
  CoefsAt coefs_at(tapes, setting);
  std::vector<double> jumps, before(tapes.coef_count), after(tapes.coef_count);
  std::vector<double> sizes(tapes.coef_count);  // over the period: one may vanish where it bends
  for (std::size_t i = 0; i <= breaks.size(); ++i) {
    const double from = i == 0 ? 0.0 : breaks[i - 1];
    const double to = i < breaks.size() ? breaks[i] : 1.0;
    for (const double share : {0.25, 0.5, 0.75}) {
      const double phase = from + share * (to - from);
      coefs_at(phase, phase, before.data());
      for (std::size_t j = 0; j < sizes.size(); ++j) {
        sizes[j] = std::max(sizes[j], std::fabs(before[j]));
      }
    }
  }
  for (std::size_t i = 0; i < breaks.size(); ++i) {
    const double from = i == 0 ? 0.0 : breaks[i - 1];
    const double to = i + 1 < breaks.size() ? breaks[i + 1] : 1.0;
    coefs_at(breaks[i], 0.5 * (from + breaks[i]), before.data());
    coefs_at(breaks[i], 0.5 * (breaks[i] + to), after.data());
    bool jumps_here = false;
    for (std::size_t j = 0; j < before.size(); ++j) {
      const double size = std::max({std::fabs(before[j]), std::fabs(after[j]), sizes[j]});
      jumps_here |= std::fabs(after[j] - before[j]) > kRounding * size;
    }
    if (jumps_here) jumps.push_back(breaks[i]);
  }
  return jumps;
}

std::string radians(const std::vector<double>& phases) {
  std::vector<std::string> texts;
  for (const double phase : phases) texts.push_back(fmt::format("{:.6g}", kWholePhase * phase));
  return fmt::format("{} {}", phases.size() == 1 ? "phase" : "phases", fmt::join(texts, ", "));
}

}  // namespace

std::vector<double> break_phases_of(const Tapes& tapes, const ModelSetting& setting) {
  std::vector<double> phases = listed_phases(tapes, setting);
  std::vector<double> listed = phases;
  std::ranges::sort(listed);
  for (const double phase : found_phases(tapes, setting)) {
    if (!is_near(phase, listed)) phases.push_back(phase);
  }
  return phases;
}

std::vector<std::string> broken_promises(const Tapes& tapes, const ModelSetting& setting) {
  if (tapes.listed == 0) return {};
  const std::vector<double> found = found_phases(tapes, setting);
  std::vector<double> listed = listed_phases(tapes, setting);
  std::ranges::sort(listed);
  std::vector<double> missed, idle, bounds = found;
  const std::size_t turns = turns_of(tapes, setting);
  for (std::size_t turn = 1; turn < turns; ++turn) {
    bounds.push_back(static_cast<double>(turn) / static_cast<double>(turns));
  }
  std::ranges::sort(bounds);
  for (const double phase : jumps_among(tapes, setting, bounds)) {
    if (!is_near(phase, listed)) missed.push_back(phase);
  }
  for (const double phase : listed) {
    if (!is_near(phase, bounds) && !is_near(phase, {0.0})) idle.push_back(phase);
  }
  std::vector<std::string> notices;
  if (!missed.empty()) {
    notices.push_back(fmt::format(
        "{}: the equations jump at {}, which [forcing] jumps does not list; steps end there, too",
        tapes.file, radians(missed)));
  }
  if (!idle.empty()) {
    notices.push_back(fmt::format("{}: [forcing] jumps lists {}, where no equation jumps",
                                  tapes.file, radians(idle)));
  }
  return notices;
}

}  // namespace gearsweep
