// Text for gnuplot: literal strings, labels and units as in print.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "result/result_file.hpp"

namespace gearsweep {

// A gnuplot string of this text, which may be markup; nothing in it is taken for a command, a macro
// or a variable.
std::string quote(std::string_view text);

// At most so many bytes of a text, and "..." in place of the rest: anyone may have written it, and
// gnuplot takes minutes over megabytes.
inline constexpr std::size_t kLongestText = 500;
std::string shortened(std::string_view text, std::size_t longest = kLongestText);

// Markup that shows exactly this text, as far as it is not too long.
std::string literal(std::string_view text);

// Markup of a text with its symbols as in print: b_n with a subscript, varpi as the letter.
std::string typeset(std::string_view text);

// Markup of what a parameter, state or unit is called in print: "omega" is an italic letter, "x1"
// has a subscript. Empty when the name is a word rather than a symbol.
std::string symbol_of(const std::string& name);

// Markup " (k0 b_n)" with symbols; empty for the unit "1".
std::string unit_markup(const std::string& unit);

// Markup of what the axis is of, in words and as a symbol, with its unit: "mesh frequency ω/ϖ".
// Without the words where they are too long for an axis.
std::string axis_label(const ResultAxis& axis);

// Markup of a quantity, a state or a signal by its name, as in print: "largest meshing force (k0
// b_n)" of "dmf_max".
std::string quantity_label(const std::string& name, const std::string& unit);

// The same with words of somebody's own, where there are any.
std::string quantity_label(const std::string& name, const std::string& unit,
                           const std::optional<std::string>& words);

// Markup of what a state or a signal of a trace is, in words where its file has some, as a symbol
// and with its unit: "deflection of the first mesh x1 (µm)"; "velocity v1 (mm/s)" of "velocity of
// x1".
std::string channel_label(const ChannelInfo& channel);

// Markup of "mu=0.1, b=1" with its symbols.
std::string settings_label(const std::string& text);

// The text in lines, broken at blanks, of at most `width` letters where that can be done.
std::vector<std::string> wrapped(std::string_view text, std::size_t width);

// The first list whose names differ from each other; where none has, the first, numbered.
std::vector<std::string> first_distinct(const std::vector<std::vector<std::string>>& lists);

}  // namespace gearsweep
