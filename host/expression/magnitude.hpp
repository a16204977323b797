// How large an expression's terms are, whatever they cancel to: its rounding is a few units in the
// last place of that.
#pragma once

#include "expression/expression.hpp"

namespace gearsweep {

// |a| + |b| of a sum, |a| |b| of a product, the larger one of a minimum; of a function its value.
NodeId magnitude_of(ExpressionGraph* graph, NodeId id);

}  // namespace gearsweep
