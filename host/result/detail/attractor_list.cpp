#include "result/detail/attractor_list.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "study/selection.hpp"

namespace gearsweep {

void add_attractors(const SweepResult& result, const FileNotes& notes, Dataset* out) {
  const Study& study = result.study;
  const std::vector<Attractor>& list = result.attractors;
  const auto add = [&](const std::string& name, const std::string& unit, const std::string& meaning,
                       const auto& value) {
    std::vector<double> values;
    for (const Attractor& attractor : list) values.push_back(value(attractor));
    out->variables.push_back({.name = name,
                              .stored = Stored::real,
                              .dimensions = {kAttractorNumber},
                              .attributes = notes.describe(unit, meaning),
                              .elements = std::move(values)});
  };
  const ChannelInfo& first = study.model->states.front();
  add("attractor_motion_class", "", "kind of motion of each attractor",
      [](const Attractor& a) { return static_cast<double>(a.motion); });
  add_flags(motion_names(), &out->variables.back().attributes);
  add("attractor_period", "1", "period in forcing periods; 0: none",
      [](const Attractor& a) { return a.period; });
  add(fmt::format("attractor_{}_rms", first.name), first.unit,
      fmt::format("root mean square of {}, mean over the attractor's trajectories", first.name),
      [](const Attractor& a) { return a.rms; });
  if (const ChannelInfo* force = study.model->contact_force()) {
    add(fmt::format("attractor_{}_max", force->name), force->unit,
        "largest dynamic meshing force of the attractor",
        [](const Attractor& a) { return a.peak; });
  }
  std::vector<std::string> impacts;
  for (const Attractor& attractor : list) impacts.push_back(attractor.impacts);
  if (std::ranges::any_of(impacts, [](const std::string& text) { return !text.empty(); })) {
    add_texts("attractor_impacts",
              "forcing periods, impacts on the drive flank and on the back flank of the motion",
              kAttractorNumber, impacts, out);
  }
  add("attractor_lyapunov_max", "1/tau",
      "largest Lyapunov exponent, mean over the attractor's trajectories",
      [](const Attractor& a) { return a.exponent; });
  add("attractor_share", "1", "share of all trajectories that reached the attractor",
      [&](const Attractor& a) {
        return static_cast<double>(a.trajectories) / static_cast<double>(study.trajectories());
      });
}

}  // namespace gearsweep
