#include "cli/detail/stop_on_signals.hpp"

#include "cli/standard_streams.hpp"

namespace gearsweep {

void tell_long_compiles(Scheduler* scheduler, bool quiet) {
  if (quiet) return;
  scheduler->compile_watch().on_long([] { tell("compiling the kernels for this study\n"); });
}

const std::atomic<bool>* stop_on_signals(SignalWatch* signals, bool quiet,
                                         const std::shared_ptr<Scheduler>& scheduler) {
  tell_long_compiles(scheduler.get(), quiet);
  signals->end_while([scheduler] { return scheduler->compile_watch().is_at_work(); });
  signals->set(OnSignal::stop);
  return &signals->interrupted();
}

}  // namespace gearsweep
