// The observables of kernels/observables/ as the host sees them: their lists, nothing else.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace gearsweep {

// In a count, stands for the model's number of states: 3 + 2 * kPerState is 3 and two per state.
constexpr int kPerState = 1 << 16;

enum class ObservableKind {
  channel,  // one instance per state or signal; quantities are CHANNEL_suffix
  step,     // sees each step; quantities are NAME_suffix
  section,  // a series of values at phase 0; the quantity is NAME
  tangent,  // sees the growth of tangent vectors; quantities are NAME or NAME_suffix
  orbit,    // sees state and growth at phase 0; quantities are NAME or NAME_suffix
};

struct ObservableOutput {
  std::string suffix;
  std::string unit;                // empty: the unit of the channel
  std::vector<std::string> flags;  // names of the classes 0, 1, ... when the value is a class
  std::string meaning;
};

struct Observable {
  std::string name;
  ObservableKind kind;
  int accumulators;  // numbers that it keeps for each point between rounds; counts in kPerState
  int tangents;      // tangent vectors that it needs; counts in kPerState
  // Name of the dimension of its outputs, one number for each state; empty: plain numbers.
  std::string dimension;
  std::vector<std::string> needed_signals;  // what a model must offer
  std::vector<ObservableOutput> outputs;
};

// All built-in observables, by name.
const std::vector<Observable>& observables();

}  // namespace gearsweep
