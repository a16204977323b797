#include "cli/detail/roff_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <string_view>

#include "model/names.hpp"

namespace gearsweep {
namespace {

constexpr std::size_t kHeading = 2, kText = 4, kDeeper = 4;  // columns before a line

// "--set a.b='x'" of "\fB\-\-set\fR a.b=\(aqx\(aq"
std::string plain_line(std::string_view line) {
  std::string out;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] != '\\') {
      out += line[i];
      continue;
    }
    const char escape = ++i < line.size() ? line[i] : '\0';
    if (escape == 'f') {
      ++i;  // a font
    } else if (escape == '(') {
      out += '\'';
      i += 2;
    } else if (escape == 'e') {
      out += '\\';
    } else if (escape == '-') {
      out += '-';
    }
  }
  return out;
}

// "gearsweep(1)" of "gearsweep (1)": words in fonts by turns, without blanks.
std::string joined_words(std::string text) {
  std::erase(text, ' ');
  return text;
}

class PlainPage {
 public:
  explicit PlainPage(std::size_t columns) : columns_(columns) {}

  void take(const std::string& line) {
    if (line.starts_with('.')) {
      take_request(line);
    } else if (is_tag_) {
      begin_paragraph(kText, plain_line(line));
      indent_ = kText + kDeeper;
      is_tag_ = false;
    } else if (is_kept_) {
      add_line(indent_, plain_line(line));
    } else {
      words_ += words_.empty() ? "" : " ";
      words_ += plain_line(line);
    }
  }

  std::string text() {
    fill();
    return out_;
  }

 private:
  void take_request(const std::string& line) {
    const std::size_t blank = std::min(line.find(' '), line.size());
    const std::string request = line.substr(0, blank);
    const std::string rest = plain_line(line.substr(std::min(blank + 1, line.size())));
    if (request == ".SH" || request == ".SS") {
      begin_paragraph(request == ".SH" ? 0 : kHeading, rest);
      indent_ = kText;
    } else if (request == ".PP") {
      fill();
      indent_ = kText;
      is_new_ = true;
    } else if (request == ".TP") {
      fill();
      is_tag_ = true;
    } else if (request == ".nf" || request == ".fi") {
      fill();
      is_kept_ = request == ".nf";
    } else if (request == ".RS" || request == ".RE") {
      fill();
      indent_ += request == ".RS" ? kDeeper : 0;
      indent_ -= request == ".RE" ? kDeeper : 0;
    } else if (request == ".br") {
      fill();
    } else if (request == ".BR") {
      take(joined_words(rest));
    } else if (request != ".TH") {
      throw std::logic_error("unknown request of roff: " + line);
    }
  }

  void begin_paragraph(std::size_t indent, const std::string& line) {
    fill();
    is_new_ = true;
    add_line(indent, line);
  }

  void add_line(std::size_t indent, const std::string& line) {
    if (is_new_ && !out_.empty()) out_ += '\n';
    is_new_ = false;
    out_ += std::string(line.empty() ? 0 : indent, ' ') + line + '\n';
  }

  // Writes the words that wait, as many in a line as there is room for.
  void fill() {
    std::string line;
    for (const std::string& word : split_words(words_)) {
      if (!line.empty() && indent_ + line.size() + 1 + word.size() > columns_) {
        add_line(indent_, line);
        line.clear();
      }
      line += line.empty() ? word : " " + word;
    }
    if (!line.empty()) add_line(indent_, line);
    words_.clear();
  }

  std::size_t columns_;
  std::string out_, words_;
  std::size_t indent_ = 0;
  bool is_tag_ = false, is_kept_ = false, is_new_ = false;
};

}  // namespace

std::string plain_page(const std::string& roff, int columns) {
  PlainPage page(static_cast<std::size_t>(std::max(columns, 1)));
  for (const std::string& line : split(roff, '\n')) {
    if (!line.empty()) page.take(line);
  }
  return page.text();
}

}  // namespace gearsweep
