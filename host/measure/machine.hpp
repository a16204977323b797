// The machine that is measured, as it is now.
#pragma once

#include <string>

namespace gearsweep {

struct Machine {
  std::string host_name;
  unsigned cores = 1;         // logical ones
  double mhz_per_core = 0.0;  // at most, where the system tells that; 0: not known
  bool scales_clock = false;  // cores slow down when there is little to do
  double load = 0.0;          // running processes, mean over the last minute

  // Above this load, what is measured may say more about other programs.
  double quiet_load() const { return 0.25 * cores; }
  bool is_busy() const { return load > quiet_load(); }
};

Machine this_machine();

// Seconds of processor time of this process so far, of all its threads.
double core_seconds();

}  // namespace gearsweep
