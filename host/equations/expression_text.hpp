// What may be said and worked out of the text of an expression alone.
#pragma once

#include <cstddef>
#include <string>

#include "model/expression_text.hpp"

namespace gearsweep {

// Throws InputError "place: message" with a caret under the place. position: byte of the text.
[[noreturn]] void fail_in(const ExpressionText& text, std::size_t position,
                          const std::string& message);

// What an expression of numbers alone comes to, as "pi + pi/sqrt(25)": finite. Throws InputError.
double number_of(const ExpressionText& text);

}  // namespace gearsweep
