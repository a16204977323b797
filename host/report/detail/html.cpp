#include "report/detail/html.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>

#include "model/error.hpp"

namespace gearsweep {
namespace {

constexpr std::string_view kStyle = R"(
@page { size: A4; margin: 11mm 14mm 10mm; }
body { font: 15px/1.4 "DejaVu Sans", sans-serif; max-width: 1100px; margin: 1.5em auto;
  padding: 0 1em; color: #111; }
h1 { font-size: 1.5em; margin: 0.3em 0 0.5em; }
h2 { font-size: 1.15em; margin: 1.6em 0 0.5em; border-bottom: 1px solid #999; }
h3 { font-size: 1em; margin: 1em 0 0.3em; }
p, ul { margin: 0.5em 0; }
ul { padding-left: 1.3em; }
.answer { border-left: 5px solid #0072b2; background: #eef5fa; padding: 0.6em 0.9em; margin: 0.8em 0; }
.answer p { margin: 0.3em 0; } .answer p:first-child { font-size: 1.15em; }
table { border-collapse: collapse; margin: 0.6em 0; max-width: 100%; }
th, td { padding: 0.15em 1em 0.15em 0; text-align: left; vertical-align: top; }
th:last-child, td:last-child { padding-right: 0.2em; }
.even { width: 100%; table-layout: fixed; } .even tr > :first-child { width: 40%; }
thead th { border-bottom: 1px solid #999; } tbody tr:nth-child(even) { background: #f4f4f4; }
.numbers th:not(:first-child), .numbers td:not(:first-child) { text-align: right; }
code, .raw { font-family: "DejaVu Sans Mono", monospace; overflow-wrap: anywhere; }
code { font-size: 0.9em; } .raw { font-size: 0.72em; color: #666; }
.figures { display: flex; gap: 2%; margin: 0.8em 0; }
figure { margin: 0; width: 49%; } figure img { width: 100%; height: auto; }
figcaption, .small { font-size: 0.85em; color: #444; overflow-wrap: anywhere; }
.columns { columns: 2; column-gap: 2.5em; } .columns > *:first-child { margin-top: 0; }
.columns table { width: 100%; }
@media screen and (max-width: 760px) {
  .figures { display: block; } figure { width: 100%; margin: 0.8em 0; } .columns { columns: 1; } }
h1, h2, h3, h2 + p, h3 + p { break-after: avoid; }
figure, .figures, .answer, table, tr, li { break-inside: avoid; }
.columns table { break-inside: auto; }
table + .small { break-before: avoid; }
p { orphans: 3; widows: 3; }
@media print {
  body { font-size: 8pt; line-height: 1.25; max-width: none; margin: 0; padding: 0; }
  h1 { font-size: 14pt; margin-top: 0; } h2 { margin: 0.9em 0 0.4em; }
  th, td { padding-top: 0.08em; padding-bottom: 0.08em; } p, ul { margin: 0.35em 0; }
  .columns table { font-size: 7.5pt; }
  .answer, tbody tr:nth-child(even) { print-color-adjust: exact; }
  details { display: none; } }
)";

// RFC 4648.
std::string base64(const std::string& bytes) {
  constexpr std::string_view kLetters =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    unsigned group = 0;
    for (std::size_t j = 0; j < 3; ++j) {
      const unsigned byte = i + j < bytes.size() ? static_cast<unsigned char>(bytes[i + j]) : 0U;
      group = (group << 8U) | byte;
    }
    const std::size_t letters = 1 + std::min<std::size_t>(3, bytes.size() - i);
    for (std::size_t j = 0; j < 4; ++j) {
      text += j < letters ? kLetters[(group >> (18U - 6U * j)) & 63U] : '=';
    }
  }
  return text;
}

// An attribute has no elements in it.
std::string without_tags(const std::string& html) {
  std::string text;
  bool is_tag = false;
  for (const char letter : html) {
    if (letter == '<') is_tag = true;
    if (!is_tag) text += letter;
    if (letter == '>') is_tag = false;
  }
  return text;
}

std::string list_of(const std::vector<std::string>& items, const char* opening) {
  std::string html = fmt::format("{}\n", opening);
  for (const std::string& item : items) html += fmt::format("<li>{}</li>\n", item);
  return html + "</ul>\n";
}

void add_cells(const std::vector<std::string>& cells, const char* kind, std::string* body) {
  *body += "<tr>";
  for (const std::string& cell : cells) *body += fmt::format("<{0}>{1}</{0}>", kind, cell);
  *body += "</tr>\n";
}

std::string figure_of(const HtmlFigure& figure) {
  std::ifstream in(figure.svg, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  if (!in || bytes.empty()) {
    throw RunError(fmt::format("the picture '{}' cannot be read", figure.svg));
  }
  return fmt::format(
      "<figure><img alt=\"{}\" src=\"data:image/svg+xml;base64,{}\" />\n"
      "<figcaption>{}</figcaption></figure>\n",
      without_tags(figure.caption), base64(bytes), figure.caption);
}

}  // namespace

std::string html_text(std::string_view text) {
  std::string html;
  for (const char letter : text) {
    const bool is_control = static_cast<unsigned char>(letter) < ' ' && letter != '\n';
    switch (letter) {
      case '&':
        html += "&amp;";
        break;
      case '<':
        html += "&lt;";
        break;
      case '>':
        html += "&gt;";
        break;
      case '"':
        html += "&quot;";
        break;
      case '\'':
        html += "&#39;";
        break;
      default:
        html += is_control ? ' ' : letter;
    }
  }
  return html;
}

std::string html_number(double number) {
  const double size = std::abs(number);
  constexpr double kWhole = 1e3, kLong = 1e7;
  return size >= kWhole && size < kLong ? fmt::format("{:.0f}", number)
                                        : fmt::format("{:.4g}", number);
}

std::string html_percent(double share) {
  const double percent = 100.0 * share;
  constexpr double kSmall = 0.095, kFew = 9.95;
  if (percent > 0.0 && percent < kSmall) return "less than 0.1 %";
  return percent > 0.0 && percent < kFew ? fmt::format("{:.1f} %", percent)
                                         : fmt::format("{:.0f} %", percent);
}

std::string html_named(const std::string& words, std::string_view name) {
  return fmt::format("{} <span class=\"raw\">{}</span>", words, html_text(name));
}

std::string html_unit(const std::string& unit) {
  if (unit == "1") return "";
  std::string html = html_text(unit);
  const auto replace = [&](std::string_view word, std::string_view shown) {
    for (std::size_t at = 0; (at = html.find(word, at)) != std::string::npos; at += shown.size()) {
      html.replace(at, word.size(), shown);
    }
  };
  replace("varpi", "ϖ");
  replace("k0", "k<sub>0</sub>");
  replace("b_n", "b<sub>n</sub>");
  return html;
}

void HtmlPage::answer(const std::string& sentence, const std::vector<std::string>& more) {
  body_ += fmt::format("<div class=\"answer\">\n<p><b>{}</b></p>\n", sentence);
  for (const std::string& html : more) paragraph(html);
  body_ += "</div>\n";
}

void HtmlPage::heading(const std::string& html) { body_ += fmt::format("<h2>{}</h2>\n", html); }

void HtmlPage::subheading(const std::string& html) { body_ += fmt::format("<h3>{}</h3>\n", html); }

void HtmlPage::paragraph(const std::string& html) { body_ += fmt::format("<p>{}</p>\n", html); }

void HtmlPage::small(const std::string& html) {
  body_ += fmt::format("<p class=\"small\">{}</p>\n", html);
}

void HtmlPage::list(const std::vector<std::string>& items) {
  if (!items.empty()) body_ += list_of(items, "<ul>");
}

void HtmlPage::small_list(const std::vector<std::string>& items) {
  if (!items.empty()) body_ += list_of(items, "<ul class=\"small\">");
}

void HtmlPage::table(const HtmlTable& table) {
  body_ += fmt::format("<table class=\"{}{}\">\n", table.is_numbers ? "numbers" : "words",
                       table.is_even ? " even" : "");
  if (!table.head.empty()) {
    body_ += "<thead>";
    add_cells(table.head, "th", &body_);
    body_ += "</thead>\n";
  }
  body_ += "<tbody>\n";
  for (const std::vector<std::string>& row : table.rows) add_cells(row, "td", &body_);
  body_ += "</tbody>\n</table>\n";
}

void HtmlPage::table(const std::vector<std::string>& head,
                     const std::vector<std::vector<std::string>>& rows) {
  table(HtmlTable{head, rows});
}

void HtmlPage::begin_columns() { body_ += "<div class=\"columns\">\n"; }

void HtmlPage::end_columns() { body_ += "</div>\n"; }

void HtmlPage::begin_details(const std::string& html) {
  body_ += fmt::format("<details><summary>{}</summary>\n", html);
}

void HtmlPage::end_details() { body_ += "</details>\n"; }

void HtmlPage::figures(const std::vector<HtmlFigure>& figures) {
  for (std::size_t i = 0; i < figures.size(); ++i) {
    if (i % 2 == 0) body_ += "<div class=\"figures\">\n";
    body_ += figure_of(figures[i]);
    if (i % 2 == 1 || i + 1 == figures.size()) body_ += "</div>\n";
  }
}

std::string HtmlPage::text() const {
  return fmt::format(
      "<!DOCTYPE html>\n<html xmlns=\"http://www.w3.org/1999/xhtml\" lang=\"en\">\n<head>\n"
      "<meta charset=\"utf-8\" />\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; "
      "style-src 'unsafe-inline'\" />\n<title>{0}</title>\n<style>{1}</style>\n</head>\n<body>\n"
      "<h1>{0}</h1>\n{2}</body>\n</html>\n",
      html_text(title_), kStyle, body_);
}

}  // namespace gearsweep
