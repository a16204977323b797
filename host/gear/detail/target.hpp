// What a drawing gives to a model.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "gear/conversion.hpp"

namespace gearsweep {

// Collects it, as far as the model has it.
class GearTarget {
 public:
  GearTarget(const GearDrawing& drawing, const Model& model) : drawing_(drawing), model_(model) {}

  // A parameter; i: its place in a list. `origin`: the key that a message about this number is
  // about. Throws DrawingError for a number out of the range that the model gives it.
  void add(const std::string& name, double value, const GearKey& origin, std::string note,
           std::size_t i = 0);
  void add_curve(const std::string& name, std::shared_ptr<const PeriodicTable> curve) {
    out_.curves[name] = std::move(curve);
  }
  void choose(const std::string& option, const std::string& choice) {
    out_.options.push_back({option, choice});
  }
  void note(std::string text) { out_.notes.push_back(std::move(text)); }

  GearConversion take() { return std::move(out_); }

 private:
  const GearDrawing& drawing_;
  const Model& model_;
  GearConversion out_;
};

}  // namespace gearsweep
