#include "plot/detail/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <set>
#include <utility>

#include "model/names.hpp"
#include "plot/labels.hpp"

namespace gearsweep {
namespace {

bool is_word_letter(char letter) {
  return std::isalnum(static_cast<unsigned char>(letter)) != 0 || letter == '_';
}

// Words that are Greek letters in print.
const std::map<std::string, std::string>& greek() {
  static const std::map<std::string, std::string> kLetters = {
      {"alpha", "α"}, {"beta", "β"},  {"delta", "δ"}, {"eps", "ε"}, {"gamma", "γ"}, {"kappa", "κ"},
      {"mu", "μ"},    {"omega", "ω"}, {"phi", "φ"},   {"psi", "ψ"}, {"rho", "ρ"},   {"sigma", "σ"},
      {"tau", "τ"},   {"theta", "θ"}, {"varpi", "ϖ"}, {"zeta", "ζ"}};
  return kLetters;
}

std::string italic(const std::string& letter) { return fmt::format("{{/:Italic {}}}", letter); }

// The symbol of "x", "omega"; empty of other words.
std::string letter_of(const std::string& word) {
  const auto found = greek().find(word);
  if (found != greek().end()) return italic(found->second);
  const bool is_letter =
      word.size() == 1 && std::isalpha(static_cast<unsigned char>(word.front())) != 0;
  return is_letter ? italic(word) : "";
}

bool is_number(const std::string& text) {
  return !text.empty() && text.size() <= 2 &&
         std::all_of(text.begin(), text.end(),
                     [](unsigned char letter) { return std::isdigit(letter) != 0; });
}

// In running text a single letter is a word.
std::string typeset_word(const std::string& word) {
  const std::string symbol = word.size() > 1 ? symbol_of(word) : "";
  return symbol.empty() ? literal(word) : symbol;
}

// What is known of names of quantities. Markup.
const std::map<std::string, std::string>& known_names() {
  static const std::map<std::string, std::string> kNames = {
      {"dmf", "meshing force"},
      {"deflection", "mesh deflection"},
      {"backlash", "half backlash at work"},
      {"mesh_stiffness", "mesh stiffness"},
      {"friction", "friction force"},
      {"friction_lever", "friction lever"},
      {"dte", "transmission error"},
      {"bearing_p", "force on the pinion's bearing"},
      {"bearing_g", "force on the gear's bearing"},
      {"power_damping", "power that damping takes"},
      {"power_friction", "power that friction takes"},
      {"dynamic_load_factor", "dynamic load factor"},
      {"contact_impacts_drive", "impacts on the drive flank per period"},
      {"contact_impacts_back", "impacts on the back flank per period"},
      {"contact_impacts_speed", "speed of the hardest impact"},
      {"contact_impacts_depth", "largest depth after an impact"},
      {"attractor", "attractor"},
      {"attractor_count", "number of attractors"},
      {"contact_back", "share of time on the back flank"},
      {"contact_class", "impacts"},
      {"contact_class_double_sided_share", "share of draws that hit both flanks"},
      {"contact_class_no_impact_share", "share of draws that stay in contact"},
      {"contact_class_single_sided_share", "share of draws that lose contact on one flank"},
      {"contact_class_wedged_share", "share of draws held on both flanks"},
      {"diverged_share", "share of draws that diverged"},
      {"contact_drive", "share of time on the drive flank"},
      {"contact_gap", "share of time without contact"},
      {"contact_losses", "contact losses per period"},
      {"contact_wedged", "share of time on both flanks"},
      {"kaplan_yorke", "Kaplan–Yorke dimension"},
      {"lyapunov_max", "largest Lyapunov exponent"},
      {"lyapunov_max_error", "error of the largest Lyapunov exponent"},
      {"lyapunov_max_per_period", "largest Lyapunov exponent per period"},
      {"lyapunov_spectrum", "Lyapunov exponents"},
      {"motion_class", "kind of motion"},
      {"period", "period in forcing periods"},
      {"settled", "periods until settled"},
      {"zero_one", "0–1 test for chaos"}};
  return kNames;
}

std::string words_of(const std::string& name) {
  std::string words = name;
  std::replace(words.begin(), words.end(), '_', ' ');
  return literal(words);
}

// What several contacts or forces have of their own: "share of time without contact (second)" of
// "second_contact_gap". Empty of other names.
std::string markup_of_one(const std::string& name) {
  for (const auto& [known, words] : known_names()) {
    const bool may_be_several = known.starts_with("contact_") || known == "dynamic_load_factor";
    if (!may_be_several || !name.ends_with("_" + known)) continue;
    return fmt::format("{} ({})", words, words_of(name.substr(0, name.size() - known.size() - 1)));
  }
  return "";
}

std::string name_markup(const std::string& name);

// "amplitude of transmission error, order 2" of "dte_order_2_amplitude"; empty of other names.
std::string markup_of_order(const std::string& name) {
  constexpr std::string_view kOrder = "_order_";
  const std::size_t order = name.rfind(kOrder);
  const std::size_t end = name.rfind('_');
  if (order == std::string::npos || end <= order + kOrder.size()) return "";
  std::string number = name.substr(order + kOrder.size(), end - order - kOrder.size());
  const std::string what = name.substr(end + 1);
  if (number.find_first_not_of("0123456789_") != std::string::npos) return "";
  if (what != "amplitude" && what != "phase") return "";
  std::ranges::replace(number, '_', '.');
  return fmt::format("{} of {}, order {}", what, name_markup(name.substr(0, order)), number);
}

// Without a unit.
std::string name_markup(const std::string& name) {
  const auto known = known_names().find(name);
  if (known != known_names().end()) return known->second;
  if (const std::string own = markup_of_one(name); !own.empty()) return own;
  if (const std::string order = markup_of_order(name); !order.empty()) return order;
  const std::string symbol = symbol_of(name);
  if (!symbol.empty()) return symbol;
  static const std::map<std::string, std::string> kAverages = {
      {"_max", "largest "},          {"_mean", "mean of "},
      {"_min", "smallest "},         {"_order_amplitude", "amplitude of "},
      {"_order_phase", "phase of "}, {"_peak_to_peak", "range of "},
      {"_rms", "rms of "},           {"_std", "standard deviation of "}};
  for (const auto& [ending, words] : kAverages) {
    if (name.ends_with(ending)) {
      return words + name_markup(name.substr(0, name.size() - ending.size()));
    }
  }
  const std::size_t colon = name.find(':');
  if (colon == std::string::npos) return words_of(name);
  return fmt::format("{} {}", name_markup(name.substr(0, colon)), literal(name.substr(colon + 1)));
}

// "torsional mesh displacement" of "torsional mesh displacement R_p theta_p - e(t)": up to a
// formula or what explains it further. "velocity" of "velocity of x1", whose letter says the rest.
std::string first_words(const std::string& meaning) {
  const std::string clause = meaning.substr(0, meaning.find_first_of(":,;("));
  if (clause.starts_with("velocity of ")) return "velocity";
  std::string words;
  for (const std::string& word : split_words(clause)) {
    if (word.find('_') != std::string::npos) break;
    const bool is_article = word == "a" || word == "an" || word == "the";
    if (words.empty() && is_article) continue;
    words += (words.empty() ? "" : " ") + word;
  }
  return words;
}

}  // namespace

std::string quote(std::string_view text) {
  std::string quoted = "\"";
  for (const char letter : text) {
    // gnuplot looks for macros and for commands to run in strings too, so what could begin one is
    // written by its number.
    const bool risky = std::string_view("\"'`@").find(letter) != std::string_view::npos;
    if (letter == '\\') {
      quoted += "\\\\";
    } else if (risky || static_cast<unsigned char>(letter) < ' ') {
      quoted += fmt::format("\\{:03o}", static_cast<unsigned char>(letter));
    } else {
      quoted += letter;
    }
  }
  return quoted + "\"";
}

std::string shortened(std::string_view text, std::size_t longest) {
  if (text.size() <= longest) return std::string(text);
  const auto goes_on = [&](std::size_t i) {  // inside a letter of UTF-8
    return (static_cast<unsigned char>(text[i]) & 0xc0U) == 0x80U;
  };
  std::size_t end = longest;
  while (end > 0 && goes_on(end)) --end;
  return std::string(text.substr(0, end)) + "...";
}

std::string literal(std::string_view text) {
  std::string markup;
  for (const char letter : shortened(text)) {
    if (std::string_view("\\{}^_@&~").find(letter) != std::string_view::npos) markup += '\\';
    markup += letter;
    // Lest what follows makes the number of a letter of it: U+0041.
    if (letter == '\\') markup += "{}";
  }
  return markup;
}

std::string typeset(std::string_view text) {
  std::string markup, word;
  for (const char letter : shortened(text)) {
    if (is_word_letter(letter)) {
      word += letter;
      continue;
    }
    markup += typeset_word(word) + literal(std::string(1, letter));
    word.clear();
  }
  return markup + typeset_word(word);
}

std::string symbol_of(const std::string& name) {
  const std::string whole = letter_of(name);
  if (!whole.empty()) return whole;
  const std::size_t underscore = name.find('_');
  if (underscore != std::string::npos) {
    const std::string stem = letter_of(name.substr(0, underscore));
    const std::string index = name.substr(underscore + 1);
    const bool is_index = index.size() == 1 || is_number(index);
    return stem.empty() || !is_index ? "" : fmt::format("{}_{{{}}}", stem, literal(index));
  }
  const std::size_t digits = name.find_first_of("0123456789");
  if (digits != 1 || !is_number(name.substr(1)) || letter_of(name.substr(0, 1)).empty()) return "";
  return fmt::format("{}_{{{}}}", italic(name.substr(0, 1)), name.substr(1));
}

std::string unit_markup(const std::string& unit) {
  if (unit.empty() || unit == "1") return "";
  // A product of two symbols has no blank between them.
  const std::size_t blank = unit.find(' ');
  if (blank != std::string::npos) {
    const std::string first = symbol_of(unit.substr(0, blank));
    const std::string second = symbol_of(unit.substr(blank + 1));
    if (!first.empty() && !second.empty()) return fmt::format(" ({}{})", first, second);
  }
  return fmt::format(" ({})", typeset(unit));
}

std::string axis_label(const ResultAxis& axis) {
  constexpr std::size_t kLongest = 45;
  constexpr std::string_view kInitial = "initial ";
  const std::string symbol = symbol_of(axis.name);
  // With its words "initial velocity of x1" an initial v1 would name two states.
  if (axis.meaning.starts_with(kInitial) && !symbol.empty()) {
    return fmt::format("{}{}{}", kInitial, symbol, unit_markup(axis.unit));
  }
  const bool says_nothing = axis.meaning.empty() || axis.meaning == axis.name;
  if (says_nothing || axis.meaning.size() > kLongest) {
    return (symbol.empty() ? words_of(axis.name) : symbol) + unit_markup(axis.unit);
  }
  // The pinion's speed has no symbol of its own.
  if (axis.unit == "rpm") return typeset(axis.meaning) + unit_markup(axis.unit);
  // A parameter of a list has its name in its meaning, too: "amplitude of the error (e0)".
  const std::string in_list = fmt::format(" ({})", axis.name);
  if (axis.meaning.ends_with(in_list) && !symbol.empty()) {
    ResultAxis plain = axis;
    plain.meaning.resize(axis.meaning.size() - in_list.size());
    return axis_label(plain);
  }
  // A ratio of frequencies is written as one: "mesh frequency ω/ϖ". Files of earlier versions have
  // the quotient in the meaning, too.
  if (axis.unit == "varpi" && !symbol.empty()) {
    const std::string words = axis.meaning.substr(0, axis.meaning.find(" / varpi"));
    return fmt::format("{} {}/{}", typeset(words), symbol, symbol_of(axis.unit));
  }
  return typeset(axis.meaning) + (symbol.empty() ? "" : " " + symbol) + unit_markup(axis.unit);
}

std::pair<std::string, std::string> words_and_unit(const std::string& key) {
  static const std::vector<std::pair<std::string, std::string>> kUnits = {{"_N_s_per_mm", "N s/mm"},
                                                                          {"_N_per_mm", "N/mm"},
                                                                          {"_N_per_m", "N/m"},
                                                                          {"_kg_mm2", "kg mm²"},
                                                                          {"_N_m", "N m"},
                                                                          {"_kg", "kg"},
                                                                          {"_mm", "mm"},
                                                                          {"_um", "µm"},
                                                                          {"_deg", "°"},
                                                                          {"_rpm", "rpm"},
                                                                          {"_N", "N"}};
  std::string words = key, unit;
  for (const auto& [ending, name] : kUnits) {
    if (!key.ends_with(ending)) continue;
    words = key.substr(0, key.size() - ending.size());
    unit = name;
    break;
  }
  std::replace(words.begin(), words.end(), '_', ' ');
  return {words, unit};
}

std::string quantity_label(const std::string& name, const std::string& unit) {
  return name_markup(name) + unit_markup(unit);
}

std::string quantity_label(const std::string& name, const std::string& unit,
                           const std::optional<std::string>& words) {
  return words ? literal(*words) + unit_markup(unit) : quantity_label(name, unit);
}

std::string channel_label(const ChannelInfo& channel) {
  constexpr std::size_t kLongest = 35;
  const std::string symbol = symbol_of(channel.name);
  const bool is_raw = symbol.empty() && name_markup(channel.name) == words_of(channel.name) &&
                      channel.name.find_first_of("_0123456789") != std::string::npos;
  const std::string words = first_words(channel.meaning);
  const bool says_nothing = words.empty() || words == channel.name || words.size() > kLongest;
  if (says_nothing || (symbol.empty() && !is_raw)) {
    return quantity_label(channel.name, channel.unit);
  }
  return typeset(words) + (symbol.empty() ? "" : " " + symbol) + unit_markup(channel.unit);
}

std::string settings_label(const std::string& text) {
  std::string markup;
  for (const std::string& part : split(shortened(text), ',')) {
    const std::string setting = part.substr(std::min(part.find_first_not_of(' '), part.size()));
    const std::size_t equals = setting.find('=');
    if (!markup.empty()) markup += ", ";
    if (equals == std::string::npos) {
      markup += literal(setting);
      continue;
    }
    const std::string name = setting.substr(0, equals);
    const std::string symbol = symbol_of(name);
    const auto [words, unit] = words_and_unit(name);
    markup += fmt::format("{} = {}{}", symbol.empty() ? literal(words) : symbol,
                          literal(setting.substr(equals + 1)), unit.empty() ? "" : " " + unit);
  }
  return markup;
}

std::vector<std::string> wrapped(std::string_view text, std::size_t width) {
  std::vector<std::string> lines;
  for (const std::string& word : split_words(shortened(text))) {
    if (lines.empty() || lines.back().size() + 1 + word.size() > width) {
      lines.push_back(word);
    } else {
      lines.back() += " " + word;
    }
  }
  return lines;
}

std::vector<std::string> first_distinct(const std::vector<std::vector<std::string>>& lists) {
  for (const std::vector<std::string>& names : lists) {
    if (std::set<std::string>(names.begin(), names.end()).size() == names.size()) return names;
  }
  std::vector<std::string> numbered = lists.front();
  for (std::size_t i = 0; i < numbered.size(); ++i) {
    numbered[i] = fmt::format("{} {}", i + 1, numbered[i]);
  }
  return numbered;
}

}  // namespace gearsweep
