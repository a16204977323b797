// What the drawings of whole gear units have in common.
#pragma once

#include <stdexcept>

namespace gearsweep {

// Why a unit is not arranged as a model of the zoo, as a part of a sentence.
class NoArrangement : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace gearsweep
