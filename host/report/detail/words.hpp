// What quantities of a model are called in the words that its file has for them.
#pragma once

#include <optional>
#include <string>

#include "model/model.hpp"

namespace gearsweep {

// "largest force of sun and planet 1" of "dmf_s1_max", from what the model says of its signal.
// alike: that of planets 1 to so many, which are shown as one. Nothing of names that have words of
// their own in every picture, such as "dmf_max". Text.
std::optional<std::string> model_words(const Model& model, const std::string& quantity,
                                       int alike = 1);

// The same of a signal itself: "force of sun and planet 1" of "dmf_s1". Text.
std::optional<std::string> signal_words(const ChannelInfo& signal);

// What each quantity is called. HTML.
std::string words_html(const Model& model, const std::string& quantity, int alike = 1);

// What is said of a force between teeth, up to the first comma: "force of sun and planets 1 to 3".
std::string force_words(const ChannelInfo& force, int alike = 1);

// The mesh whose teeth a contact is of: "sun and planet 1" of "sun1", by the one force that is said
// to be of what the contact is called; otherwise the contact's name. Text.
std::string contact_words(const Model& model, const std::string& contact, int alike = 1);

// A quantity whose name has a number behind its first letters: "dmf_s1_max".
struct NumberedQuantity {
  std::string before, after;  // "dmf_s", "_max"
  int number = 0;
  std::string stem() const { return before + std::to_string(number); }
};
std::optional<NumberedQuantity> numbered(const std::string& quantity);

// Whether number 1 and the other are the same of equal parts, such as planets: what the model says
// of their signals differs in the number alone, or they are contacts of one name.
bool are_of_equal_parts(const Model& model, const NumberedQuantity& first,
                        const NumberedQuantity& other);

}  // namespace gearsweep
