#include "report/detail/words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>
#include <utility>
#include <vector>

#include "model/names.hpp"
#include "model/parse_number.hpp"
#include "plot/labels.hpp"
#include "report/detail/html.hpp"

namespace gearsweep {
namespace {

constexpr std::string_view kForceOf = "force of ";

bool is_digit(char letter) { return std::isdigit(static_cast<unsigned char>(letter)) != 0; }

std::string spaced(std::string name) {
  std::ranges::replace(name, '_', ' ');
  return name;
}

// Up to the first comma, without an article, as other words come before it.
std::string first_clause(const std::string& meaning) {
  std::string clause = meaning.substr(0, meaning.find(','));
  for (const std::string_view article : {"the ", "a ", "an "}) {
    if (clause.starts_with(article)) return clause.substr(article.size());
  }
  return clause;
}

const ChannelInfo* find_signal(const Model& model, const std::string& name) {
  const auto found = std::ranges::find(model.signals, name, &ChannelInfo::name);
  return found == model.signals.end() ? nullptr : &*found;
}

// The signal that a quantity is of, whose name it begins with: the longest such name.
const ChannelInfo* signal_of(const Model& model, const std::string& quantity) {
  const ChannelInfo* longest = nullptr;
  for (const ChannelInfo& signal : model.signals) {
    if (!quantity.starts_with(signal.name + "_")) continue;
    if (longest == nullptr || signal.name.size() > longest->name.size()) longest = &signal;
  }
  return longest;
}

// A name that is a word says what it is, and so do those that pictures have words for.
bool has_own_words(const ChannelInfo& signal) {
  return signal.name.find_first_of("_0123456789") == std::string::npos ||
         quantity_html(signal.name) != html_text(spaced(signal.name));
}

// "order 2 of the X" of "_order_2_amplitude"; empty of other endings.
std::string order_words(const std::string& ending, const std::string& what) {
  constexpr std::string_view kOrder = "_order_", kAmplitude = "_amplitude";
  if (!ending.starts_with(kOrder) || !ending.ends_with(kAmplitude)) return "";
  std::string number =
      ending.substr(kOrder.size(), ending.size() - kOrder.size() - kAmplitude.size());
  std::ranges::replace(number, '_', '.');
  return fmt::format("order {} of the {}", number, what);
}

std::string with_ending(const std::string& ending, const std::string& what) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 6> kEndings = {
      {{"_max", "largest "},
       {"_min", "smallest "},
       {"_mean", "mean of the "},
       {"_peak_to_peak", "range of the "},
       {"_rms", "rms of the "},
       {"_std", "standard deviation of the "}}};
  for (const auto& [known, words] : kEndings) {
    if (ending == known) return std::string(words) + what;
  }
  if (ending == "_dynamic_load_factor") {
    return what.starts_with(kForceOf) ? "dynamic load factor of " + what.substr(kForceOf.size())
                                      : fmt::format("dynamic load factor ({})", what);
  }
  return order_words(ending, what);
}

// "sun", "1" of "sun1".
std::vector<std::string> parts_of(const std::string& name) {
  std::vector<std::string> parts;
  for (std::size_t i = 0; i < name.size(); ++i) {
    if (name[i] == '_') continue;
    const bool goes_on = i > 0 && name[i - 1] != '_' && is_digit(name[i]) == is_digit(name[i - 1]);
    if (!goes_on) parts.emplace_back();
    parts.back() += name[i];
  }
  return parts;
}

// What is said of the one force whose words have all parts of the contact's name; empty where there
// are none, or several.
std::string clause_of_contact(const Model& model, const std::string& contact) {
  const std::vector<std::string> parts = parts_of(contact);
  std::string found;
  for (const ChannelInfo& force : model.signals_of(Role::mesh_force)) {
    const std::string clause = first_clause(force.meaning);
    const std::vector<std::string> words = split_words(clause);
    const bool is_named = std::ranges::all_of(parts, [&](const std::string& part) {
      return std::ranges::find(words, part) != words.end();
    });
    if (!is_named || !clause.starts_with(kForceOf)) continue;
    if (!found.empty()) return "";
    found = clause;
  }
  return found;
}

// Of names that pictures have no better words for.
std::optional<std::string> words_of_contact(const Model& model, const std::string& quantity,
                                            int alike) {
  constexpr std::string_view kGap = "_contact_gap";
  if (!quantity.ends_with(kGap)) return std::nullopt;
  const std::string contact = quantity.substr(0, quantity.size() - kGap.size());
  if (std::ranges::find(model.contacts, contact, &ContactInfo::name) == model.contacts.end()) {
    return std::nullopt;
  }
  const std::string words = contact_words(model, contact, alike);
  if (words == contact) return std::nullopt;
  return "share of time without contact of " + words;
}

// "planets 1 to 3" in place of "planet 1".
std::string several_words(const std::string& words, int alike) {
  const std::size_t at = words.find(" 1");
  const bool is_number =
      at != std::string::npos && (at + 2 == words.size() || !is_digit(words[at + 2]));
  if (alike < 2 || !is_number) return words;
  return fmt::format("{}s 1 to {}{}", words.substr(0, at), alike, words.substr(at + 2));
}

}  // namespace

std::string force_words(const ChannelInfo& force, int alike) {
  if (force.meaning.empty()) return force.name;
  return several_words(first_clause(force.meaning), alike);
}

std::string contact_words(const Model& model, const std::string& contact, int alike) {
  const std::string clause = clause_of_contact(model, contact);
  if (!clause.empty()) return several_words(clause.substr(kForceOf.size()), alike);
  return alike < 2 ? contact : fmt::format("{} to {}", contact, alike);
}

std::optional<std::string> model_words(const Model& model, const std::string& quantity, int alike) {
  const ChannelInfo* const signal = signal_of(model, quantity);
  if (signal == nullptr) return words_of_contact(model, quantity, alike);
  if (signal->meaning.empty() || has_own_words(*signal)) return std::nullopt;
  // As the one that pictures have words for is called.
  constexpr std::string_view kDynamic = "dynamic ";
  std::string what = force_words(*signal, alike);
  const bool is_error = signal->role == Role::transmission_error;
  if (is_error && what.starts_with(kDynamic)) what.erase(0, kDynamic.size());
  const std::string words = with_ending(quantity.substr(signal->name.size()), what);
  return words.empty() ? std::nullopt : std::optional(words);
}

std::optional<std::string> signal_words(const ChannelInfo& signal) {
  if (signal.meaning.empty() || has_own_words(signal)) return std::nullopt;
  return force_words(signal);
}

std::string words_html(const Model& model, const std::string& quantity, int alike) {
  const std::optional<std::string> words = model_words(model, quantity, alike);
  return words ? html_text(*words) : quantity_html(quantity);
}

std::optional<NumberedQuantity> numbered(const std::string& quantity) {
  const auto begin = std::ranges::find_if(quantity, is_digit);
  const auto end = std::find_if_not(begin, quantity.end(), is_digit);
  if (begin == quantity.end() || begin == quantity.begin() || end == quantity.end()) {
    return std::nullopt;
  }
  const std::optional<int> number = parse_number<int>(std::string(begin, end));
  if (*end != '_' || !number) return std::nullopt;
  return NumberedQuantity{{quantity.begin(), begin}, {end, quantity.end()}, *number};
}

bool are_of_equal_parts(const Model& model, const NumberedQuantity& first,
                        const NumberedQuantity& other) {
  if (first.before != other.before || first.after != other.after || first.number != 1) return false;
  const auto has_contact = [&](const NumberedQuantity& one) {
    return std::ranges::find(model.contacts, one.stem(), &ContactInfo::name) !=
           model.contacts.end();
  };
  if (has_contact(first) && has_contact(other)) return true;
  const ChannelInfo* const a = find_signal(model, first.stem());
  const ChannelInfo* const b = find_signal(model, other.stem());
  if (a == nullptr || b == nullptr) return false;
  const std::string one = " 1", number = fmt::format(" {}", other.number);
  const std::size_t at = a->meaning.find(one);
  if (at == std::string::npos) return false;
  std::string expected = a->meaning;
  expected.replace(at, one.size(), number);
  return expected == b->meaning;
}

}  // namespace gearsweep
