#include "model/held_step.hpp"

#include <algorithm>

namespace gearsweep {

std::vector<double> StepMoments::operator()(double share) const {
  std::vector<double> coefs(width);
  (*row_at)(std::min(phase + share * length, 1.0), inside, coefs.data());
  return coefs;
}

}  // namespace gearsweep
