// Numbers of steps that points share whose phase tables no other draw has.
#pragma once

#include <cstddef>
#include <vector>

namespace gearsweep {

// Where a draw has phase tables of its own, its points at the values of the axes are all that can
// share one, and the lanes of a work-item. Each with its own number of steps would leave most lanes
// empty. So some of them take more steps than they ask for.
class SharedSteps {
 public:
  // Every number is its own.
  SharedSteps() = default;
  // steps: of each point of a draw. Chooses among their numbers what costs least, where lanes come
  // by fours, whatever the device has: so the numbers in a result do not depend on it.
  explicit SharedSteps(std::vector<std::size_t> steps);

  // The smallest of the chosen numbers that is at least this; beyond them, itself.
  std::size_t at_least(std::size_t steps) const;

 private:
  std::vector<std::size_t> chosen_;  // rising
};

}  // namespace gearsweep
