// Studies as text, as a user writes them into a file.
#pragma once

#include <fmt/format.h>

#include <string>

#include "model/model.hpp"

namespace gearsweep::testing {

// The coarse gear over omega from 0.5 to 1.5 and, unless it has no values, e0 from 0.1 to 0.7.
// rest: the other tables.
inline std::string coarse_study(std::size_t omega_count, std::size_t e0_count,
                                const std::string& rest) {
  const auto axis = [](const char* name, double from, double to, std::size_t count) {
    return fmt::format("[[axes]]\nname = '{}'\nfrom = {}\nto = {}\ncount = {}\n", name, from, to,
                       count);
  };
  return "[model]\npreset = 'coarse'\n" + axis("omega", 0.5, 1.5, omega_count) +
         (e0_count > 0 ? axis("e0", 0.1, 0.7, e0_count) : "") + rest;
}

// A model with a parameter that is called as a quantity, `period`: from push to push. It needs an
// axis yet.
inline constexpr const char* kPushed = R"toml([model]
text = """
[model]
name = "pushed"
[states]
x = {}
v = {}
[parameters]
period = { value = 1.0, min = 0.5, max = 10.0, meaning = "time from push to push" }
c = 0.2
[equations]
x = "v"
v = "sin(phase) - x - c*v"
[forcing]
period = "period"
"""
)toml";

// Extremes and averages of all channels of a model, and its sections. Tests that ask for the same
// share the kernels, which take longer to build than to run.
inline std::string observe_all_of(const Model& model) {
  std::string quantities, sampled;
  for (const auto& list : {model.states, model.signals}) {
    for (const ChannelInfo& channel : list) {
      if (channel.is_hidden) continue;
      for (const char* what : {"_min", "_max", "_mean", "_rms"}) {
        quantities += "'" + channel.name + what + "', ";
      }
    }
  }
  for (const ChannelInfo& state : model.states) sampled += "'" + state.name + "', ";
  return fmt::format("[observe]\nquantities = [{}'poincare']\npoincare = [{}]\n", quantities,
                     sampled);
}

// What most tests look at of gear5: all of its sections, and the extremes and averages that are
// cheap. One program for all that ask for it, where an axis does not shape the phase table.
inline const std::string kSectionsOfGear5 =
    "poincare = ['x1', 'x2', 'x3', 'x4', 'x5', 'v1', 'v2', 'v3', 'v4', 'v5']\n";
inline const std::string kObserveGear5 =
    "[observe]\nquantities = ['x1_min', 'x1_max', 'x1_mean', 'x1_rms', 'x1_std', 'dmf_min', "
    "'dmf_max', 'contact_drive', 'contact_gap', 'contact_back', 'contact_wedged', "
    "'contact_losses', 'contact_class', 'poincare']\n" +
    kSectionsOfGear5;

// And the same for what is said of the kind of motion.
inline const std::string kObserveMotionOfGear5 =
    "[observe]\nquantities = ['motion_class', 'period', 'settled', 'lyapunov_max', "
    "'lyapunov_max_error', 'x1_rms', 'dmf_max', 'contact_class', 'poincare']\n" +
    kSectionsOfGear5;

// Eight points with tolerances: 8 x (1 + 10 x 4) trajectories in tiles that cut through the draws
// of each point.
inline const std::string kTolerantStudy = coarse_study(4, 2, R"([integrate]
settle = 60
record = 16
tile = 30
[observe]
quantities = ["dmf_max", "contact_class"]
[uncertain]
samples = 10
sobol = true
keep = true
mu = {distribution = "normal", std = 0.005}
omega = {distribution = "uniform", from = 0.98, to = 1.02, relative = true}
)");

// A study of a model that is given as text, with more keys of the study.
inline std::string study_of_text(const std::string& model, const std::string& keys) {
  return "[model]\ntext = '''\n" + model + "'''\n" + keys;
}

}  // namespace gearsweep::testing
