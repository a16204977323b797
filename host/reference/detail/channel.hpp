// A state or a signal, as an observable of the reference engine reads it from moments.
#pragma once

#include <optional>
#include <string>

#include "model/model.hpp"
#include "reference/detail/step_curve.hpp"
#include "reference/detail/trajectory.hpp"

namespace gearsweep {

// Reads a state or a signal from a moment.
class Channel {
 public:
  Channel(const Model& model, const std::string& name)
      : is_state_(model.find_state(name) >= 0),
        index_(is_state_ ? model.find_state(name) : model.find_signal(name)) {}
  double operator()(const Instant& moment) const {
    return is_state_ ? moment.state[index_] : moment.signals[index_];
  }

 private:
  bool is_state_;
  Eigen::Index index_;
};

// The curve of a channel, or of anything else that a moment has.
template <class Value>
StepCurve curve_of(const TrajectoryStep& step, const Value& value) {
  std::optional<double> earlier;
  if (step.earlier) earlier = value(*step.earlier);
  return {value(step.before), value(step.middle), value(step.after), earlier};
}

}  // namespace gearsweep
