// A computation that a signal stops.
#pragma once

#include "cli/detail/signal_watch.hpp"
#include "sweep/sweep_options.hpp"

namespace gearsweep {

// It stops after the running round; while its kernels are compiled, the program ends. What is in
// the journal is safe at any time. Unless `quiet`, it is told that the compiler takes long.
void stop_on_signals(SignalWatch* signals, bool quiet, SweepOptions* options);

}  // namespace gearsweep
