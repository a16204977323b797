// A page of HTML that is well-formed XML, too. What is text stays text.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace gearsweep {

// The text with what HTML would take for more than text written by its name, and without characters
// that no XML may have.
std::string html_text(std::string_view text);

// Four digits, and no power of ten where a reader needs none.
std::string html_number(double number);

// A unit as in print: "k0 b_n" with its indices.
std::string html_unit(const std::string& unit);

class HtmlPage {
 public:
  explicit HtmlPage(const std::string& title) : title_(title) {}

  // These take HTML; whoever has text takes html_text().
  void heading(const std::string& html);
  void paragraph(const std::string& html);
  void list(const std::vector<std::string>& items);
  void table(const std::vector<std::string>& head,
             const std::vector<std::vector<std::string>>& rows);
  // What is shown on demand; until end_details().
  void begin_details(const std::string& html);
  void end_details();
  // svg: a file. It becomes a part of the page, in which nothing can run.
  void picture(const std::string& svg, const std::string& caption);

  std::string text() const;

 private:
  std::string title_, body_;
};

}  // namespace gearsweep
