// A page of HTML that is well-formed XML, too, for the screen and for A4. What is text stays text,
// and nothing in the page runs or is fetched.
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

// A share as per cent: "12 %", "0.3 %".
std::string html_percent(double share);

// A unit as in print: "k0 b_n" with its indices.
std::string html_unit(const std::string& unit);

// What the trade calls it, with the program's own name small beside it. words: HTML; name: text.
std::string html_named(const std::string& words, std::string_view name);

// A picture with what stands below it. svg: a file; caption: HTML.
struct HtmlFigure {
  std::string svg, caption;
};

// A table, all of HTML.
struct HtmlTable {
  std::vector<std::string> head;               // of each column; empty: there is none
  std::vector<std::vector<std::string>> rows;  // the first cell of a row says what the row is of
  bool is_numbers = false;                     // all but the first column are right-aligned
  bool is_even = false;  // it is as wide as the page, and all but the first are as wide as another
};

class HtmlPage {
 public:
  explicit HtmlPage(const std::string& title) : title_(title) {}

  // These take HTML; whoever has text takes html_text().

  // What a reader takes away who reads nothing else: a sentence, and smaller what goes with it.
  void answer(const std::string& sentence, const std::vector<std::string>& more = {});
  // It stays with what follows it.
  void heading(const std::string& html);
  void subheading(const std::string& html);
  void paragraph(const std::string& html);
  void small(const std::string& html);  // a paragraph of what few readers want
  void list(const std::vector<std::string>& items);
  void small_list(const std::vector<std::string>& items);
  void table(const HtmlTable& table);
  void table(const std::vector<std::string>& head,
             const std::vector<std::vector<std::string>>& rows);
  // What stands in two columns where the page is wide enough; until end_columns().
  void begin_columns();
  void end_columns();
  // What is shown on demand, and not printed; until end_details().
  void begin_details(const std::string& html);
  void end_details();
  // Two beside each other where the page is wide enough: draw them kFigureWidth wide. A file
  // becomes a part of the page, in which nothing can run. Throws RunError.
  void figures(const std::vector<HtmlFigure>& figures);

  std::string text() const;

  static constexpr double kFigureWidth = 85.0;  // mm

 private:
  std::string title_, body_;
};

}  // namespace gearsweep
