// Letters of pictures for matplotlib.
#pragma once

#include <string>
#include <string_view>

namespace gearsweep {

// What gnuplot's markup shows, as literal() and typeset() write it, with symbols and indices
// between '$'. Nothing else in it is taken for a command.
std::string mathtext_of(std::string_view markup);

}  // namespace gearsweep
