// A model's field and its Jacobian at one state, of the states that a study integrates.
#pragma once

#include <vector>

#include "model/model.hpp"

namespace gearsweep {

struct LocalField {
  std::vector<double> rates;     // [state]
  std::vector<double> jacobian;  // [row][column]; not finite of a state that has diverged
};

// At phase 0. own: a state of `model`, which may be a reduced one: the states that it leaves out
// drive none of those that it has.
LocalField local_field_at(const Model& model, const ModelSetting& setting,
                          const std::vector<double>& own);

}  // namespace gearsweep
