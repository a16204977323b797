// A command that makes several runs and tells of each.
#pragma once

#include <functional>
#include <string>

#include "cli/detail/signal_watch.hpp"
#include "sweep/several_runs.hpp"

namespace gearsweep {

// Has `runs` tell of each step with the time that has passed, unless `quiet`, and stop on a signal;
// then calls `work`, which is false when it was stopped. Tells where the output is. The exit
// status.
int tell_several_runs(SeveralRuns* runs, const std::string& output, bool quiet,
                      SignalWatch* signals, const std::function<bool()>& work);

}  // namespace gearsweep
