#include "plot/detail/mathtext.hpp"

#include <array>
#include <vector>

namespace gearsweep {
namespace {

// What opens a group in markup, and how the group stands between '$'.
struct MathGroup {
  std::string_view mark, opening, closing;
};
constexpr std::array<MathGroup, 4> kMathGroups = {{{"{/:Italic ", "$", "$"},
                                                   {"_{", "$_{\\mathrm{", "}}$"},
                                                   {"^{", "$^{\\mathrm{", "}}$"},
                                                   {"{", "", ""}}};

std::string math_letter(char letter) { return letter == '$' ? "\\$" : std::string(1, letter); }

}  // namespace

std::string mathtext_of(std::string_view markup) {
  std::string out;
  std::vector<std::string_view> closings;  // of the groups that are open
  for (std::size_t i = 0; i < markup.size();) {
    const std::string_view rest = markup.substr(i);
    if (rest.front() == '\\' && rest.size() > 1) {
      out += math_letter(rest[1]);
      i += 2;
      continue;
    }
    if (rest.front() == '}' && !closings.empty()) {
      out += closings.back();
      closings.pop_back();
      ++i;
      continue;
    }
    const MathGroup* opened = nullptr;
    for (const MathGroup& group : kMathGroups) {
      if (opened == nullptr && rest.starts_with(group.mark)) opened = &group;
    }
    if (opened != nullptr) {
      out += opened->opening;
      closings.push_back(opened->closing);
      i += opened->mark.size();
    } else {
      out += math_letter(rest.front());
      ++i;
    }
  }
  for (; !closings.empty(); closings.pop_back()) out += closings.back();
  return out;
}

}  // namespace gearsweep
