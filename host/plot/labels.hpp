// What axes and quantities are called in pictures: for programs that plot their own with matplotlib
// as text with symbols between '$' (mathtext), for pages as HTML.
#pragma once

#include <string>
#include <string_view>
#include <utility>

#include "result/result_file.hpp"

namespace gearsweep {

// What the axis is of, in words and as a symbol, with its unit: "mesh frequency $ω$/$ϖ$".
std::string axis_mathtext(const ResultAxis& axis);

// A quantity, a state or a signal by its name, as in print: "largest meshing force ($k$...)" of
// "dmf_max".
std::string quantity_mathtext(const std::string& name, const std::string& unit);

// The same without its unit.
std::string quantity_html(const std::string& name);

// A key of a drawing as words and a unit: {"mesh stiffness", "N/m"} of "mesh_stiffness_N_per_m".
// Text; other names have no unit.
std::pair<std::string, std::string> words_and_unit(const std::string& key);

// Exactly this text; and the same with its symbols as in print.
std::string literal_mathtext(std::string_view text);
std::string typeset_mathtext(std::string_view text);

}  // namespace gearsweep
