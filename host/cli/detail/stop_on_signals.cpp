#include "cli/detail/stop_on_signals.hpp"

#include "cli/standard_streams.hpp"

namespace gearsweep {

void stop_on_signals(SignalWatch* signals, bool quiet, SweepOptions* options) {
  const std::shared_ptr<OpenDevices> open = options->open;
  if (!quiet) {
    open->compile_watch().on_long([] { tell("compiling the kernels for this study\n"); });
  }
  signals->end_while([open] { return open->compile_watch().is_at_work(); });
  options->stop = &signals->interrupted();
  signals->set(OnSignal::stop);
}

}  // namespace gearsweep
