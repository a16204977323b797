#include "cli/detail/several_runs.hpp"

#include <chrono>

#include "cli/commands.hpp"
#include "cli/detail/progress_bar.hpp"
#include "cli/detail/stop_on_signals.hpp"
#include "cli/standard_streams.hpp"

namespace gearsweep {

int tell_several_runs(SeveralRuns* runs, const std::string& output, bool quiet,
                      SignalWatch* signals, const std::function<bool()>& work) {
  const auto start = std::chrono::steady_clock::now();
  if (!quiet) {
    runs->on_step = [start](const std::string& what) {
      const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
      tell("{:>8}  {}\n", format_duration(spent.count()), what);
    };
  }
  runs->stop = stop_on_signals(signals, quiet, runs->scheduler);
  if (!work()) return tell_interrupted();
  if (!quiet) tell("{}\n", output);
  return kDone;
}

}  // namespace gearsweep
