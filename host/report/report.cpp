#include "report/report.hpp"

#include <fmt/format.h>

#include <optional>

#include "model/error.hpp"
#include "model/version.hpp"
#include "plot/plot.hpp"
#include "report/detail/equal_parts.hpp"
#include "report/detail/highlights.hpp"
#include "report/detail/load_spectrum.hpp"
#include "report/detail/page_file.hpp"
#include "report/detail/sections.hpp"

namespace gearsweep {
namespace {

std::string title_of(const Study& study) {
  return study.title.empty() ? "Report on " + study.model->name : study.title;
}

std::string title_of(const ReportStudies& studies) {
  const std::string first = title_of(studies.front().study);
  if (studies.size() == 1) return first;
  const std::string second = title_of(studies.back().study);
  const std::string names = fmt::format("{} against {}", studies.front().name, studies.back().name);
  return first == second ? fmt::format("{}: {}", first, names) : names;
}

// Nothing when stopped.
std::optional<ReportFindings> find_side(const ReportStudies& studies, std::size_t index,
                                        ReportOptions options) {
  const std::string name = studies.size() > 1 ? studies[index].name : "";
  if (options.on_step && !name.empty()) {
    options.on_step = [inner = options.on_step, name](const std::string& step) {
      inner(fmt::format("{}: {}", name, step));
    };
  }
  std::optional<ReportFindings> findings = find_for_report(studies[index].study, options);
  if (findings) findings->name = name;
  return findings;
}

void add_answers(const Sides& sides, HtmlPage* page) {
  for (const ReportFindings& findings : sides) {
    const std::string answer = answer_html(findings);
    page->answer(
        findings.name.empty() ? answer : fmt::format("{}: {}", html_text(findings.name), answer),
        remarks_html(findings));
  }
}

}  // namespace

void ensure_report(const ReportStudies& studies, const std::string& path) {
  ensure_page_file(path);
  for (const ReportStudy& one : studies) {
    if (!one.study.spectrum) find_speed_axis(one.study);
    if (one.study.spectrum.has_value() != studies.front().study.spectrum.has_value()) {
      throw InputError(
          "one of the studies is a load spectrum and the other goes over a speed: compare two "
          "spectra, or two studies over a speed");
    }
  }
  if (studies.front().study.scales.known() != studies.back().study.scales.known()) {
    throw InputError(fmt::format(
        "'{}' and '{}' cannot be compared: one has a [gear] table, so rpm and N, and the other has "
        "none",
        studies.front().name, studies.back().name));
  }
  ensure_plottable(path.substr(0, path.rfind('.')) + ".svg");
}

bool write_report(const ReportStudies& studies, const std::string& path,
                  const ReportOptions& options) {
  ensure_report(studies, path);
  const Study& first = studies.front().study;
  if (first.spectrum) return write_spectrum_report(studies, title_of(studies), path, options);
  Sides sides;
  for (std::size_t i = 0; i < studies.size(); ++i) {
    std::optional<ReportFindings> findings = find_side(studies, i, options);
    if (!findings) return false;
    sides.push_back(*std::move(findings));
  }
  join_equal_parts(&sides);
  if (options.on_step) options.on_step("pictures");
  HtmlPage page(title_of(studies));
  add_answers(sides, &page);
  add_differences(sides, &page);
  add_worst_speeds(sides, &page);
  add_natural_frequencies(sides, &page);
  add_pictures(sides, &page);
  add_tolerances(sides, &page);
  add_assumptions(sides, &page);
  page.small(fmt::format("gearsweep {}: <code>{}</code>", html_text(version()),
                         html_text(options.command_line)));
  write_page(page, path);
  return true;
}

}  // namespace gearsweep
