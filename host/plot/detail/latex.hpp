// Letters of pictures for LaTeX, and how wide they are.
#pragma once

#include <string>
#include <string_view>

namespace gearsweep {

// LaTeX that shows what gnuplot's markup shows, as literal() and typeset() write it. Nothing in it
// is taken for a command: all letters that LaTeX gives a meaning to are written by their names.
std::string latex_of(std::string_view markup);

// The width of what the markup shows, in font sizes, as in a wide font.
double letters_width(std::string_view markup);

}  // namespace gearsweep
