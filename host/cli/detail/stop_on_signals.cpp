#include "cli/detail/stop_on_signals.hpp"

#include "cli/standard_streams.hpp"

namespace gearsweep {

void tell_long_compiles(OpenDevices* open, bool quiet) {
  if (quiet) return;
  open->compile_watch().on_long([] { tell("compiling the kernels for this study\n"); });
}

const std::atomic<bool>* stop_on_signals(SignalWatch* signals, bool quiet,
                                         const std::shared_ptr<OpenDevices>& open) {
  tell_long_compiles(open.get(), quiet);
  signals->end_while([open] { return open->compile_watch().is_at_work(); });
  signals->set(OnSignal::stop);
  return &signals->interrupted();
}

}  // namespace gearsweep
