// What a report's numbers rest on.
#include <fmt/format.h>

#include "report/detail/sections.hpp"
#include "study/initial_policy.hpp"

namespace gearsweep {
namespace {

// Of the equations of gear5 (see doc/models.md), which no option changes.
std::vector<std::string> notes_of_gear5() {
  std::vector<std::string> notes;
  notes.emplace_back("Teeth are springs, gears are rigid bodies; shafts do not bend or twist.");
  notes.emplace_back(
      "Bearings are linear springs and dampers across and along the line of action.");
  notes.emplace_back(
      "Friction between teeth is Coulomb's, with a constant coefficient, in the direction of "
      "nominal sliding.");
  notes.emplace_back("The mesh damper acts for two tooth pairs at all times, out of contact, too.");
  notes.emplace_back(
      "A pair of teeth takes up its load at once where it enters: stiffness and force jump there. "
      "A "
      "helix makes it gradual.");
  notes.emplace_back("The load is constant; the transmission error acts on the mesh alone.");
  notes.emplace_back(
      "The gears turn at a constant mean speed; each speed is held until the motion has settled.");
  return notes;
}

}  // namespace

void add_assumptions(const ReportFindings& findings, HtmlPage* page) {
  const Study& study = findings.study;
  const Model& model = *study.model;
  page->heading("What was assumed");
  std::vector<std::string> notes;
  if (model.name == "gear5") notes = notes_of_gear5();
  for (std::size_t i = 0; i < model.options.size(); ++i) {
    const OptionInfo& option = model.options[i];
    notes.push_back(
        fmt::format("{}: {} ({})", html_text(option.name),
                    html_text(option.choices[static_cast<std::size_t>(study.setting.options[i])]),
                    html_text(option.meaning)));
  }
  for (const std::string& finding : model.findings) notes.push_back(html_text(finding));
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
