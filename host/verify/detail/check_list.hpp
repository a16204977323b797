// The checks themselves, each the numbers that it compares.
#pragma once

#include <vector>

#include "verify/verify.hpp"

namespace gearsweep {

// known_answers.cpp
std::vector<Compared> compare_oscillator_fp64(const Subject& subject);
std::vector<Compared> compare_oscillator_fp32(const Subject& subject);
std::vector<Compared> compare_orbits_fp64(const Subject& subject);
std::vector<Compared> compare_orbits_fp32(const Subject& subject);
std::vector<Compared> compare_exponent_sum(const Subject& subject);
std::vector<Compared> compare_published_exponents(const Subject& subject);
std::vector<Compared> compare_multipliers(const Subject& subject);
std::vector<Compared> compare_default_step(const Subject& subject);
std::vector<Compared> compare_periods(const Subject& subject);
std::vector<Compared> compare_stopped_points(const Subject& subject);

// agreement.cpp
std::vector<Compared> compare_bits(const Subject& subject);
std::vector<Compared> compare_engines_fp64(const Subject& subject);
std::vector<Compared> compare_engines_fp32(const Subject& subject);
std::vector<Compared> compare_file(const Subject& subject);

}  // namespace gearsweep
