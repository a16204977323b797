// What a report's numbers rest on.
#include <fmt/format.h>

#include "report/detail/sections.hpp"
#include "study/initial_policy.hpp"

namespace gearsweep {

void add_assumptions(const ReportFindings& findings, HtmlPage* page) {
  const Study& study = findings.study;
  const Model& model = *study.model;
  page->heading("What was assumed");
  std::vector<std::string> notes;
  for (const std::string& assumption : model.assumptions) notes.push_back(html_text(assumption));
  for (std::size_t i = 0; i < model.options.size(); ++i) {
    const OptionInfo& option = model.options[i];
    notes.push_back(
        fmt::format("{}: {} ({})", html_text(option.name),
                    html_text(option.choices[static_cast<std::size_t>(study.setting.options[i])]),
                    html_text(option.meaning)));
  }
  for (const std::string& finding : model.findings) notes.push_back(html_text(finding));
  const std::vector<ChannelInfo> forces = model.signals_of(Role::mesh_force);
  if (forces.size() > 1) {
    notes.push_back(fmt::format(
        "The model has {} forces between teeth. Speeds are ranked by {}, and the order map, run-up "
        "and run-down are its own; of the others there are the curves and the table.",
        forces.size(), html_text(forces.front().name)));
  }
  const Integrate& integrate = study.integrate;
  notes.push_back(
      fmt::format("Up to {} forcing periods settle, {} are recorded; the order map records {}.",
                  integrate.settle, integrate.record, findings.orders.study.integrate.record));
  notes.push_back(
      fmt::format("Each point starts {}; run-up and run-down go on from their "
                  "neighbour.",
                  html_text(info_of(study.initial.policy).meaning)));
  notes.push_back("The natural frequencies are those of the first of the speeds.");
  page->list(notes);
}

}  // namespace gearsweep
