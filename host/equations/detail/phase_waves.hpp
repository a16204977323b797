// Waves of the phase, such as sin(3*phase), that must close within a period.
#pragma once

#include <string>
#include <vector>

#include "equations/detail/phase_breaks.hpp"
#include "expression/tape.hpp"

namespace gearsweep {

// Nodes: symbols of the phase and of how often it has begun anew, and how often it does in a
// period.
struct PhaseSymbols {
  NodeId phase, turn, cycle;
};

// The waves of some expressions of the phase and of parameters: sines, cosines and tangents of what
// grows steadily with the phase. With a factor that is not whole, such as sin(0.7*phase), one is
// nearly surely meant as a function of time: the phase begins anew in each period, and the wave
// with it. A value type; the graph is not needed any more.
class PhaseWaves {
 public:
  PhaseWaves() = default;
  // inputs: all that the roots depend on beside phase and turn. Adds to the graph.
  PhaseWaves(ExpressionGraph* graph, const std::vector<NodeId>& inputs, const PhaseSymbols& symbols,
             const std::vector<NodeId>& roots);

  // What is wrong with the first wave that does not go on from the end of a period into the next
  // one; empty if nothing. A wave that is read at one end of the period alone, as a pulse is, may
  // have any factor; so may one whose square or size is read, which goes on.
  // breaks: of the same roots, given the turn, too. Throws InputError as PhaseBreaks::find().
  std::string check(const std::vector<double>& inputs, const PhaseBreaks& breaks) const;

 private:
  struct Wave {
    std::string text;
    Tape factor;  // of the inputs: waves in a period
    Tape values;  // of inputs, turn and phase: each root, and with this wave of the next period
  };
  // Inputs with a turn, and a stretch of the phase without breaks.
  struct Stretch {
    std::vector<double> inputs;
    double from, to;
  };
  bool breaks_off(const Tape& values, const Stretch& first, const Stretch& last) const;
  std::vector<bool> differ(const Tape& values, const Stretch& stretch) const;

  Tape all_;  // the same with all waves of the next period
  Tape cycle_;
  std::size_t roots_ = 0;
  std::vector<Wave> waves_;  // those whose factor need not be whole
};

}  // namespace gearsweep
