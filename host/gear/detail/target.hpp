// What a drawing gives to a model.
#pragma once

#include <fmt/format.h>

#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "gear/conversion.hpp"
#include "model/names.hpp"

namespace gearsweep {

// Collects it, as far as the model has it. In the model, names have the suffix. Notes are written
// as fmt::format() does, and only where somebody reads them: to write them takes longer than all
// else.
class GearTarget {
 public:
  // Throws DrawingError for a key of the drawing that gives nothing that the model has.
  GearTarget(const GearDrawing& drawing, const Model& model, std::string suffix, GearTexts texts);

  bool has_texts() const { return texts_ == GearTexts::all; }

  // Whether the model has what the key alone gives.
  bool takes(const GearKey& key) const;
  bool has_parameter(const std::string& name) const {
    return model_.find_parameter(name + suffix_) >= 0;
  }

  // How often the model has the mesh damping cm at any time. gear5 has it in each of two pairs of
  // teeth, as the paper does; models of several drawings once.
  int mesh_dampers() const { return suffix_.empty() ? 2 : 1; }

  // A parameter, and the note on it. `origin`: the key that a message about this number is about.
  // Throws DrawingError for a number out of the range that the model gives it, and where the model
  // has no such parameter, but for a 0 and for what follows from other keys, too.
  template <typename... Args>
  void add(const std::string& name, double value, const GearKey& origin,
           fmt::format_string<Args...> note, Args&&... args) {
    add_noted(full_name(name), value, origin, note, fmt::make_format_args(args...));
  }
  // The same of number i of a list.
  template <typename... Args>
  void add_to_list(const std::string& name, std::size_t i, double value, const GearKey& origin,
                   fmt::format_string<Args...> note, Args&&... args) {
    add_noted(name_in_list(full_name(name), i), value, origin, note,
              fmt::make_format_args(args...));
  }
  void add_curve(const std::string& name, std::shared_ptr<const PeriodicTable> curve);
  void choose(const std::string& option, const std::string& choice);
  template <typename... Args>
  void note(fmt::format_string<Args...> text, Args&&... args) {
    if (has_texts()) out_.notes.push_back(fmt::format(text, std::forward<Args>(args)...));
  }

  GearConversion take() { return std::move(out_); }

 private:
  bool has_curve(std::string_view name) const;
  std::string full_name(const std::string& name) const;
  void add_noted(std::string name, double value, const GearKey& origin, fmt::string_view note,
                 fmt::format_args args);

  const GearDrawing& drawing_;
  const Model& model_;
  std::string suffix_;
  GearTexts texts_;
  GearConversion out_;
};

}  // namespace gearsweep
