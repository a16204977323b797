// What a sample tells of the share of all points that something is true of.
#pragma once

#include <cstddef>

namespace gearsweep {

// The share that is not exceeded at 95 % confidence, where it is true of `found` among `points`
// points: the one-sided bound of Clopper and Pearson, Biometrika 26 (1934) 404-413. Where nothing
// is found it is about 3/points. 1 where all are found, or there are no points.
double upper_share(std::size_t found, std::size_t points);

}  // namespace gearsweep
