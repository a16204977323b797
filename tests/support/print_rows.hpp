// How tests print the rows of known answers.
#pragma once

#include <ostream>

#include "verify/detail/reference_rows.hpp"

namespace gearsweep {

inline void PrintTo(const ReferenceRow& row, std::ostream* out) { *out << row.name; }

}  // namespace gearsweep
