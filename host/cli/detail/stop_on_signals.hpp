// A computation that a signal stops.
#pragma once

#include <atomic>
#include <memory>

#include "cli/detail/signal_watch.hpp"
#include "scheduler/scheduler.hpp"

namespace gearsweep {

// Says so when the compiler takes long, unless `quiet`.
void tell_long_compiles(Scheduler* scheduler, bool quiet);

// The same, and a flag for the options of a computation: it is to stop after the running round.
// While its kernels are compiled, a signal ends the program instead. What is in the journal is safe
// at any time.
const std::atomic<bool>* stop_on_signals(SignalWatch* signals, bool quiet,
                                         const std::shared_ptr<Scheduler>& scheduler);

}  // namespace gearsweep
