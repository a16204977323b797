// The observables of kernels/observables/ as the host sees them: their lists, nothing else.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace gearsweep {

// In a count, these stand for the model's number of states and for the study's number of orders:
// 3 + 2 * kPerState is 3 and two per state.
constexpr int kPerState = 1 << 12;
constexpr int kPerOrder = 1 << 20;

// What is put in. perturbed: states that tangent vectors have (Model::perturbed_states()).
struct Sizes {
  std::size_t states = 0, perturbed = 0, orders = 0;
};

constexpr std::size_t numbers_of(int count, const Sizes& sizes) {
  return static_cast<std::size_t>(count % kPerState) +
         static_cast<std::size_t>(count / kPerState % (kPerOrder / kPerState)) * sizes.states +
         static_cast<std::size_t>(count / kPerOrder) * sizes.orders;
}

// The dimension of outputs that have a number for each order (study/selection.hpp), and for each
// tangent vector.
constexpr const char* kOrders = "order";
constexpr const char* kExponents = "exponent";

// What an observable is for.
enum class ObservableRole {
  measure,    // measures the steps of the recorded window
  verdict,    // judges the motion from its sections: where a longer window follows, that one counts
  statistic,  // measures the steps, too, but of the longer window where one follows
  samples,    // keeps values of each section, and has no outputs
};

// What the host makes of an output, beside a map.
enum class OutputRole {
  none,
  motion,    // the kind of motion; where it is undecided, a longer window follows
  period,    // of the motion, in forcing periods
  settled,   // periods until the motion stayed periodic
  exponent,  // largest Lyapunov exponent
  exponent_per_period,
  exponents,       // all Lyapunov exponents, or what is made of them
  exponent_error,  // its error, to which the host adds
  section_min,     // the box around the sections
  section_max,
  state_mean,  // of each state (kernels/observables/state_moments.h)
  state_std,
  state_mean_error,
  state_std_error,
  rms,            // of a channel
  peak,           // the largest value of a channel
  impacts_drive,  // on each flank of a contact, per forcing period
  impacts_back,
  angle,  // which jumps by full turns, and means nothing where what turns is small
};

struct ObservableOutput {
  std::string suffix;
  // Empty: that of what it looks at; "/tau": that of its rate; "/period": it counts how often, in a
  // period of the forcing, or of a model without forcing in its unit of time.
  std::string unit;
  std::vector<std::string> flags;  // names of the classes 0, 1, ... when the value is a class
  std::string meaning;
  OutputRole role = OutputRole::none;
};

// What an observable is made for.
enum class ObservedPart {
  whole,    // once: its quantities are NAME or NAME_suffix
  channel,  // for each state and signal: CHANNEL_suffix
  contact,  // for each contact: NAME_suffix, or CONTACT_NAME_suffix where contacts have names
  section,  // for each section of the model: SECTION_suffix
  surface,  // for each surface where the state is reset: SURFACE_suffix
};

struct Observable {
  std::string name;
  ObservableRole role;
  ObservedPart part = ObservedPart::whole;
  bool is_of_surfaces = false;  // of models that have some
  // Numbers that it keeps for each point between rounds, tangent vectors that it needs; counts in
  // kPerState and kPerOrder.
  int accumulators;
  int tangents;
  // Name of the dimension of its outputs; empty: plain numbers. Along kOrders they have a number
  // for each order, along kExponents one for each tangent vector, along others one for each state.
  std::string dimension;
  std::vector<ObservableOutput> outputs;

  bool has_each_state() const { return !dimension.empty() && dimension != kOrders; }
  // Numbers of each output.
  std::size_t width(const Sizes& sizes) const {
    if (dimension == kOrders) return sizes.orders;
    if (dimension == kExponents) return sizes.perturbed;
    return dimension.empty() ? 1 : sizes.states;
  }
  // Tangent vectors that it needs, at most one for each state that has a tangent.
  std::size_t tangents_of(const Sizes& sizes) const {
    const std::size_t wanted = numbers_of(tangents, sizes);
    return wanted < sizes.perturbed ? wanted : sizes.perturbed;
  }
};

// All built-in observables, by name.
const std::vector<Observable>& observables();

}  // namespace gearsweep
