// Lyapunov exponents of textbook systems: J. C. Sprott, Chaos and Time-Series Analysis (2003),
// appendix A (natural logarithm; the phase's zero exponent is not counted). The tolerances are
// those of the description of the models, section "Published answers".
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "engine/result.hpp"
#include "verify/compared.hpp"

namespace gearsweep {

struct PublishedExponents {
  std::string name, model, preset;
  // The published start: many starts from `first` on, in steps of a thousandth, share the rest.
  double first;
  std::string state;              // the other states
  std::vector<double> exponents;  // the largest alone when the others are not published
  double tolerance;
  std::optional<double> sum;     // of all exponents, exact: the mean of the field's divergence
  std::size_t steps_per_period;  // of 0.01 to 0.06 units of time
  std::size_t record;            // periods of each start
};

const std::vector<PublishedExponents>& published_exponents();

// The row of that name. Throws std::logic_error when there is none.
const PublishedExponents& published_exponents_of(const std::string& name);

// 64 starts of the row, as a study of one axis.
std::string study_of(const PublishedExponents& row, std::size_t steps_per_period,
                     std::size_t record);

// Each exponent, averaged over the starts.
std::vector<double> mean_exponents(const SweepResult& result);

// The exponents of study_of(row, row.steps_per_period, row.record) beside the published ones.
std::vector<Compared> compare_exponents(const PublishedExponents& row, const SweepResult& result);

}  // namespace gearsweep
