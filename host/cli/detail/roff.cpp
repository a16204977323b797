#include "cli/detail/roff.hpp"

#include <fmt/format.h>

#include "model/names.hpp"

namespace gearsweep {

std::string roff_plain(const std::string& text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool starts_line = i == 0 || text[i - 1] == '\n';
    if (starts_line && (text[i] == '.' || text[i] == '\'')) out += "\\&";
    if (text[i] == '\\') {
      out += "\\e";
    } else if (text[i] == '-') {
      out += "\\-";
    } else if (text[i] == '\'') {
      out += "\\(aq";
    } else {
      out += text[i];
    }
  }
  return out;
}

std::string roff_bold(const std::string& text) {
  return fmt::format("\\fB{}\\fR", roff_plain(text));
}
std::string roff_italic(const std::string& text) {
  return fmt::format("\\fI{}\\fR", roff_plain(text));
}

std::string roff_paragraphs(const std::string& text) {
  std::string out;
  bool in_example = false, in_paragraph = false;
  for (const std::string& line : split(text, '\n')) {
    const bool indented = line.rfind("  ", 0) == 0;
    if (in_example && !indented) out += ".RE\n.fi\n";
    if (!in_example && indented) out += ".PP\n.nf\n.RS\n";
    in_example = indented;
    if (!indented && !line.empty() && !in_paragraph) out += ".PP\n";
    in_paragraph = !indented && !line.empty();
    if (!line.empty()) out += roff_plain(indented ? line.substr(2) : line) + "\n";
  }
  return in_example ? out + ".RE\n.fi\n" : out;
}

// A heading begins a paragraph by itself.
std::string roff_section(const std::string& title, const std::string& text) {
  const std::string_view begin = ".PP\n";
  const bool has_begin = text.rfind(begin, 0) == 0;
  return fmt::format(".SH {}\n{}", title, text.substr(has_begin ? begin.size() : 0));
}

std::string roff_item(const std::string& tag, const std::string& text) {
  return fmt::format(".TP\n{}\n{}\n", tag, text);
}

}  // namespace gearsweep
