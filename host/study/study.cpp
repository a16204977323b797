#include "study/study.hpp"

namespace gearsweep {

std::size_t Study::points() const {
  std::size_t count = 1;
  for (const Axis& axis : axes) count *= axis.values.size();
  return count;
}

void Study::separate_points() {
  if (is_chained()) initial.policy = InitialPolicy::shifted;
  initial.ensemble = 1;
}

}  // namespace gearsweep
