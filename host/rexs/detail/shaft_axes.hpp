// Where the axes of shafts are.
#pragma once

#include "rexs/detail/lookup.hpp"

namespace gearsweep {

// Between two shafts that are parallel, in mm. Nothing where the file does not say both places in
// one frame, or where they are not parallel.
std::optional<double> distance_of_axes(const RexsComponent& first, const RexsComponent& second,
                                       RexsLookup* lookup);

}  // namespace gearsweep
