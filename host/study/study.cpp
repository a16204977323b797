#include "study/study.hpp"

namespace gearsweep {

std::size_t Study::points() const {
  std::size_t count = 1;
  for (const Axis& axis : axes) count *= axis.values.size();
  return count;
}

bool Study::is_chained() const {
  return initial.policy == InitialPolicy::forward || initial.policy == InitialPolicy::backward;
}

}  // namespace gearsweep
