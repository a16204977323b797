// Progress of a sweep on stderr: a bar on a terminal, plain lines otherwise.
#pragma once

#include <optional>

#include "cli/detail/pace.hpp"
#include "sweep/sweep.hpp"

namespace gearsweep {

class ProgressBar {
 public:
  ProgressBar();
  void show(const SweepProgress& progress);
  // Ends the bar's line.
  void close();

 private:
  void show_bar(const SweepProgress& progress);
  void show_line(const SweepProgress& progress);

  bool on_terminal_;
  bool bar_open_ = false;
  double last_shown_ = -1e9;  // seconds
  PaceMeter meter_;
  std::optional<Pace> pace_;
};

// "0.4 s", "31 s", "4 min 10 s", "2 h 05 min".
std::string format_duration(double seconds);

}  // namespace gearsweep
