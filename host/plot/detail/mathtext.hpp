// Letters of pictures for programs that are not gnuplot.
#pragma once

#include <string>
#include <string_view>

namespace gearsweep {

// What gnuplot's markup shows, as literal() and typeset() write it, for matplotlib: with symbols
// and indices between '$'. Nothing else in it is taken for a command.
std::string mathtext_of(std::string_view markup);

// The same as HTML: symbols are italic, indices are below.
std::string html_of(std::string_view markup);

}  // namespace gearsweep
