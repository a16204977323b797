// The points of a plan, on demand: what each has of parameters, and where it starts. It knows no
// machine and no tile. A study's grid is one source (plan/study_points.hpp), a view of a map
// another (plan/view_points.hpp).
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "model/model.hpp"

namespace gearsweep {

// Threads may share one.
class PointSource {
 public:
  virtual ~PointSource() = default;

  virtual std::size_t size() const = 0;  // below 2^32
  // Tells it apart from other sources of the same study's.
  virtual std::string key() const = 0;
  // The parameters of the model in which points differ, each once.
  virtual const std::vector<std::size_t>& differing() const = 0;
  // Gives these their values at a point, in a setting that has all others.
  virtual void set(std::size_t point, ModelSetting* setting) const = 0;
  // Where it starts when no other point's final state is its start: a state of the whole model.
  virtual std::vector<double> start(std::size_t point) const = 0;
  // Names a point in messages, as in "draw 3 of [uncertain]"; empty where its values say enough.
  virtual std::string name(std::size_t) const { return ""; }

  // Points that go on from the final state of another one stand in a later stage.
  virtual std::size_t stages() const { return 1; }
  virtual std::size_t stage_size(std::size_t) const { return size(); }
  virtual std::size_t point(std::size_t /*stage*/, std::size_t i) const { return i; }
  virtual std::optional<std::size_t> predecessor(std::size_t) const { return std::nullopt; }
  // A point of a stage mostly shares the phase grid of the one before it, or of the one so many
  // before it.
  virtual std::size_t row() const { return 1; }
};

}  // namespace gearsweep
