#include "plot/detail/latex.hpp"

#include <fmt/format.h>

#include <array>
#include <map>
#include <utility>

namespace gearsweep {
namespace {

// One letter of UTF-8 from `at` on.
std::string_view letter_at(std::string_view text, std::size_t at) {
  std::size_t end = at + 1;
  while (end < text.size() && (static_cast<unsigned char>(text[end]) & 0xc0U) == 0x80U) ++end;
  return text.substr(at, end - at);
}

std::string latex_letter(std::string_view letter) {
  static const std::map<std::string, std::string, std::less<>> kLetters = {
      {"\\", "\\textbackslash{}"},
      {"{", "\\{"},
      {"}", "\\}"},
      {"$", "\\$"},
      {"&", "\\&"},
      {"#", "\\#"},
      {"^", "\\textasciicircum{}"},
      {"_", "\\_"},
      {"~", "\\textasciitilde{}"},
      {"%", "\\%"},
      {"<", "\\textless{}"},
      {">", "\\textgreater{}"},
      {"|", "\\textbar{}"},
      {"\"", "\\char34{}"},
      {"−", "$-$"},
      {"–", "--"},
      {"·", "$\\cdot$"},
      {"×", "$\\times$"},
      {"α", "$\\alpha$"},
      {"β", "$\\beta$"},
      {"γ", "$\\gamma$"},
      {"δ", "$\\delta$"},
      {"ε", "$\\varepsilon$"},
      {"ζ", "$\\zeta$"},
      {"θ", "$\\theta$"},
      {"κ", "$\\kappa$"},
      {"λ", "$\\lambda$"},
      {"μ", "$\\mu$"},
      {"µ", "$\\mu$"},
      {"ρ", "$\\rho$"},
      {"σ", "$\\sigma$"},
      {"τ", "$\\tau$"},
      {"φ", "$\\varphi$"},
      {"ψ", "$\\psi$"},
      {"ω", "$\\omega$"},
      {"ϖ", "$\\varpi$"}};
  const auto found = kLetters.find(letter);
  return found == kLetters.end() ? std::string(letter) : found->second;
}

// A group's first letters choose how the rest is set.
struct Setting {
  std::string_view mark, opening, closing;
};
constexpr std::array<Setting, 3> kSettings = {
    {{"/:Italic ", "\\textit{", "}"}, {"/*0.85 ", "{\\small ", "}"}, {"/*0.8 ", "{\\small ", "}"}}};

constexpr std::string_view kSpecial = "^_";

}  // namespace

std::string latex_of(std::string_view markup) {
  std::string out;
  std::string closings;  // of the groups that are open, one mark each
  for (std::size_t i = 0; i < markup.size();) {
    const std::string_view letter = letter_at(markup, i);
    i += letter.size();
    if (letter == "\\" && i < markup.size()) {
      const std::string_view next = letter_at(markup, i);
      i += next.size();
      out += latex_letter(next);
    } else if (letter == "{") {
      std::string_view opening = "{";
      for (const Setting& setting : kSettings) {
        if (!markup.substr(i).starts_with(setting.mark)) continue;
        opening = setting.opening;
        i += setting.mark.size();
      }
      out += opening;
      closings += '}';
    } else if (letter == "}") {
      if (!closings.empty()) closings.pop_back();
      out += '}';
    } else if (kSpecial.find(letter) != std::string_view::npos && i < markup.size() &&
               markup[i] == '{') {
      out += letter == "^" ? "\\textsuperscript" : "\\textsubscript";
    } else if (letter == "\n") {
      out += ' ';
    } else {
      out += latex_letter(letter);
    }
  }
  return out + closings;
}

double letters_width(std::string_view markup) {
  constexpr double kScript = 0.7, kNarrow = 0.32, kWide = 0.9, kCapital = 0.68, kOther = 0.59;
  double width = 0.0, scale = 1.0;
  std::string scales;  // 's' where a group in small letters is open
  bool is_script = false;
  for (std::size_t i = 0; i < markup.size();) {
    std::string_view letter = letter_at(markup, i);
    i += letter.size();
    if (letter == "\\" && i < markup.size()) {
      letter = letter_at(markup, i);
      i += letter.size();
    } else if (letter == "{") {
      for (const Setting& setting : kSettings) {
        if (markup.substr(i).starts_with(setting.mark)) i += setting.mark.size();
      }
      scales += is_script ? 's' : 'n';
      if (is_script) scale *= kScript;
      is_script = false;
      continue;
    } else if (letter == "}") {
      if (!scales.empty() && scales.back() == 's') scale /= kScript;
      if (!scales.empty()) scales.pop_back();
      continue;
    } else if (letter == "^" || letter == "_") {
      is_script = true;
      continue;
    }
    const char first = letter.front();
    const bool is_narrow =
        std::string_view("ijl.,:;'|! ()[]tfr").find(first) != std::string_view::npos;
    const bool is_wide =
        letter == "−" || std::string_view("mwMW").find(first) != std::string_view::npos;
    width += scale * (is_narrow                      ? kNarrow
                      : is_wide                      ? kWide
                      : first >= 'A' && first <= 'Z' ? kCapital
                                                     : kOther);
  }
  return width;
}

}  // namespace gearsweep
