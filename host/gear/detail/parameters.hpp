// The parameters that a drawing gives to a model.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "gear/conversion.hpp"

namespace gearsweep {

// Collects them; each is checked against the range that the model gives it.
class GearParameters {
 public:
  GearParameters(const GearDrawing& drawing, const Model& model)
      : drawing_(drawing), model_(model) {}

  // `origin`: the key that a message about this number is about. Throws DrawingError.
  void add(std::string_view name, double value, const GearKey& origin, std::string note);

  std::vector<GearParameter> take() { return std::move(list_); }

 private:
  const GearDrawing& drawing_;
  const Model& model_;
  std::vector<GearParameter> list_;
};

}  // namespace gearsweep
