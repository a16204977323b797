// Random numbers of uncertain parameters.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

namespace gearsweep {

// A number in (0, 1) that depends on nothing but seed, stream and position: SplitMix64's output
// function (Steele, Lea, Flood, OOPSLA 2014) of the three. So draws do not depend on how work is
// cut up, nor on which other parameters are uncertain.
double uniform_at(std::size_t seed, std::string_view stream, std::size_t position);

// The quantile of the standard normal distribution, for p in (0, 1): Wichura's algorithm AS 241
// (Applied Statistics 37, 1988), to about 1e-16 of its value.
double normal_quantile(double p);

// The quantile of the triangular distribution on [from, to] with its peak at `mode`.
double triangular_quantile(double from, double mode, double to, double p);

}  // namespace gearsweep
