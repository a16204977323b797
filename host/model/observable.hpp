// The observables of kernels/observables/ as the host sees them: their lists, nothing else.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace gearsweep {

// In a count, stands for the model's number of states: 3 + 2 * kPerState is 3 and two per state.
constexpr int kPerState = 1 << 16;

// A count with that put in.
constexpr std::size_t numbers_of(int count, std::size_t states) {
  return static_cast<std::size_t>(count % kPerState) +
         static_cast<std::size_t>(count / kPerState) * states;
}

// What an observable is for.
enum class ObservableRole {
  measure,  // measures the steps of the recorded window
  verdict,  // judges the motion from its sections: where a longer window follows, that one counts
  samples,  // keeps values of each section, and has no outputs
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
  rms,   // of a channel
  peak,  // the largest value of a channel
};

struct ObservableOutput {
  std::string suffix;
  std::string unit;                // empty: the unit of the channel
  std::vector<std::string> flags;  // names of the classes 0, 1, ... when the value is a class
  std::string meaning;
  OutputRole role = OutputRole::none;
};

// What an observable is made for.
enum class ObservedPart {
  whole,    // once: its quantities are NAME or NAME_suffix
  channel,  // for each state and signal: CHANNEL_suffix
  contact,  // for each contact: NAME_suffix, or CONTACT_NAME_suffix where contacts have names
};

struct Observable {
  std::string name;
  ObservableRole role;
  ObservedPart part = ObservedPart::whole;
  int accumulators;  // numbers that it keeps for each point between rounds; counts in kPerState
  int tangents;      // tangent vectors that it needs; counts in kPerState
  // Name of the dimension of its outputs, one number for each state; empty: plain numbers.
  std::string dimension;
  std::vector<ObservableOutput> outputs;
};

// All built-in observables, by name.
const std::vector<Observable>& observables();

}  // namespace gearsweep
