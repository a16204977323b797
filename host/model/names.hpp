// Help with names that a user mistyped.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace gearsweep {

// "; did you mean 'omega'?" when one of the known names is close to `name` (by edit distance),
// otherwise "; known: a, b, c" (shortened after a dozen).
std::string suggest_name(std::string_view name, const std::vector<std::string>& known);

// Names that have all words of this one beside each other: of "speed_rpm" "pinion_speed_rpm". Empty
// where there are more than a few.
std::vector<std::string> longer_names(std::string_view name, const std::vector<std::string>& known);

// The names of what has a `name`: states, parameters, options, presets.
template <class Info>
std::vector<std::string> names_of(const std::vector<Info>& infos) {
  std::vector<std::string> names;
  for (const Info& info : infos) names.push_back(info.name);
  return names;
}

// What something of a model that is given as equations is called in the kernels. Users may take any
// name, but nothing else there begins so: no word of C or OpenCL C, no macro, and no function.
std::string kernel_name(std::string_view name);

// What the entry number i of a list is called, counted from 0: a, a_2, a_3, ...
std::string name_in_list(const std::string& list, std::size_t i);

// The words of a list such as "consistent printed".
std::vector<std::string> split_words(std::string_view words);

// "a,b" as a and b; one empty string of an empty one.
std::vector<std::string> split(std::string_view text, char separator);

}  // namespace gearsweep
