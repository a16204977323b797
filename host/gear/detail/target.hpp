// What a drawing gives to a model.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "gear/conversion.hpp"

namespace gearsweep {

// Collects it, as far as the model has it. In the model, names have the suffix.
class GearTarget {
 public:
  // Throws DrawingError for a key of the drawing that gives nothing that the model has.
  GearTarget(const GearDrawing& drawing, const Model& model, std::string suffix);

  // Whether the model has what the key alone gives.
  bool takes(const GearKey& key) const;
  bool has_parameter(const std::string& name) const {
    return model_.find_parameter(name + suffix_) >= 0;
  }

  // How often the model has the mesh damping cm at any time. gear5 has it in each of two pairs of
  // teeth, as the paper does; models of several drawings once.
  int mesh_dampers() const { return suffix_.empty() ? 2 : 1; }

  // A parameter; i: its place in a list. `origin`: the key that a message about this number is
  // about. Throws DrawingError for a number out of the range that the model gives it, and where the
  // model has no such parameter, but for a 0 and for what follows from other keys, too.
  void add(const std::string& name, double value, const GearKey& origin, std::string note,
           std::size_t i = 0);
  void add_curve(const std::string& name, std::shared_ptr<const PeriodicTable> curve);
  void choose(const std::string& option, const std::string& choice);
  void note(std::string text) { out_.notes.push_back(std::move(text)); }

  GearConversion take() { return std::move(out_); }

 private:
  bool has_curve(std::string_view name) const;

  const GearDrawing& drawing_;
  const Model& model_;
  std::string suffix_;
  GearConversion out_;
};

}  // namespace gearsweep
