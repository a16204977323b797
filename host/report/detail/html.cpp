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
body { font: 15px/1.45 "DejaVu Sans", sans-serif; max-width: 60em; margin: 2em auto; padding: 0 1em; }
h1 { font-size: 1.6em; } h2 { font-size: 1.2em; margin-top: 2em; border-bottom: 1px solid #999; }
table { border-collapse: collapse; margin: 0.8em 0; }
th, td { padding: 0.15em 0.9em 0.15em 0; text-align: left; vertical-align: top; }
thead th { border-bottom: 1px solid #999; } tbody tr:nth-child(even) { background: #f4f4f4; }
figure { margin: 1em 0; } figure img { max-width: 100%; height: auto; }
figcaption, .small { font-size: 0.85em; color: #444; }
@media print { body { font-size: 10pt; margin: 0; } figure, tr { break-inside: avoid; } }
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

void add_cells(const std::vector<std::string>& cells, const char* kind, std::string* body) {
  *body += "<tr>";
  for (const std::string& cell : cells) *body += fmt::format("<{0}>{1}</{0}>", kind, cell);
  *body += "</tr>\n";
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

void HtmlPage::heading(const std::string& html) { body_ += fmt::format("<h2>{}</h2>\n", html); }

void HtmlPage::paragraph(const std::string& html) { body_ += fmt::format("<p>{}</p>\n", html); }

void HtmlPage::list(const std::vector<std::string>& items) {
  body_ += "<ul>\n";
  for (const std::string& item : items) body_ += fmt::format("<li>{}</li>\n", item);
  body_ += "</ul>\n";
}

void HtmlPage::table(const std::vector<std::string>& head,
                     const std::vector<std::vector<std::string>>& rows) {
  body_ += "<table>\n<thead>";
  add_cells(head, "th", &body_);
  body_ += "</thead>\n<tbody>\n";
  for (const std::vector<std::string>& row : rows) add_cells(row, "td", &body_);
  body_ += "</tbody>\n</table>\n";
}

void HtmlPage::begin_details(const std::string& html) {
  body_ += fmt::format("<details><summary>{}</summary>\n", html);
}

void HtmlPage::end_details() { body_ += "</details>\n"; }

void HtmlPage::picture(const std::string& svg, const std::string& caption) {
  std::ifstream in(svg, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  if (!in || bytes.empty()) throw RunError(fmt::format("the picture '{}' cannot be read", svg));
  body_ += fmt::format(
      "<figure><img alt=\"{0}\" src=\"data:image/svg+xml;base64,{1}\" />\n"
      "<figcaption>{0}</figcaption></figure>\n",
      caption, base64(bytes));
}

std::string HtmlPage::text() const {
  return fmt::format(
      "<!DOCTYPE html>\n<html xmlns=\"http://www.w3.org/1999/xhtml\" lang=\"en\">\n<head>\n"
      "<meta charset=\"utf-8\" />\n<title>{0}</title>\n<style>{1}</style>\n</head>\n<body>\n"
      "<h1>{0}</h1>\n{2}</body>\n</html>\n",
      html_text(title_), kStyle, body_);
}

}  // namespace gearsweep
