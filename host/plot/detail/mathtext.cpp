#include "plot/detail/mathtext.hpp"

#include <array>
#include <vector>

namespace gearsweep {
namespace {

// What opens a group in markup, and what stands around the group.
struct MarkupGroup {
  std::string_view mark, opening, closing;
};
using MarkupGroups = std::array<MarkupGroup, 4>;

constexpr MarkupGroups kMathGroups = {{{"{/:Italic ", "$", "$"},
                                       {"_{", "$_{\\mathrm{", "}}$"},
                                       {"^{", "$^{\\mathrm{", "}}$"},
                                       {"{", "", ""}}};
constexpr MarkupGroups kHtmlGroups = {{{"{/:Italic ", "<i>", "</i>"},
                                       {"_{", "<sub>", "</sub>"},
                                       {"^{", "<sup>", "</sup>"},
                                       {"{", "", ""}}};

std::string math_letter(char letter) { return letter == '$' ? "\\$" : std::string(1, letter); }

std::string html_letter(char letter) {
  if (letter == '&') return "&amp;";
  if (letter == '<') return "&lt;";
  return letter == '>' ? "&gt;" : std::string(1, letter);
}

std::string rewritten(std::string_view markup, const MarkupGroups& groups,
                      std::string (*shown)(char letter)) {
  std::string out;
  std::vector<std::string_view> closings;  // of the groups that are open
  for (std::size_t i = 0; i < markup.size();) {
    const std::string_view rest = markup.substr(i);
    if (rest.front() == '\\' && rest.size() > 1) {
      out += shown(rest[1]);
      i += 2;
      continue;
    }
    if (rest.front() == '}' && !closings.empty()) {
      out += closings.back();
      closings.pop_back();
      ++i;
      continue;
    }
    const MarkupGroup* opened = nullptr;
    for (const MarkupGroup& group : groups) {
      if (opened == nullptr && rest.starts_with(group.mark)) opened = &group;
    }
    if (opened != nullptr) {
      out += opened->opening;
      closings.push_back(opened->closing);
      i += opened->mark.size();
    } else {
      out += shown(rest.front());
      ++i;
    }
  }
  for (; !closings.empty(); closings.pop_back()) out += closings.back();
  return out;
}

}  // namespace

std::string mathtext_of(std::string_view markup) {
  return rewritten(markup, kMathGroups, math_letter);
}

std::string html_of(std::string_view markup) { return rewritten(markup, kHtmlGroups, html_letter); }

}  // namespace gearsweep
