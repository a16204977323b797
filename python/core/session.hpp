// The devices of this process, and what is computed on them.
#pragma once

#include <pybind11/pybind11.h>
#include <sys/types.h>

#include <atomic>
#include <memory>
#include <string>

#include "sweep/sweep_options.hpp"

namespace gearsweep::python {

// The devices stay open with all kernels that were built for them: a run that is like an earlier
// one begins at once.
class Session {
 public:
  // To be called before anything that uses devices. Throws RunError in a process that has been
  // forked from one that uses them.
  void enter();

  // For a computation on these devices, "0,1"; empty: the default one. Enters. Throws InputError.
  SweepOptions options_for(const std::string& device);

 private:
  std::atomic<pid_t> owner_ = 0;  // the process that uses the devices; 0: none yet
  const std::shared_ptr<Scheduler> scheduler_ = std::make_shared<Scheduler>();
};

using SessionClass = pybind11::class_<Session>;

// What each file adds to the class.
void add_shards(pybind11::module_* module, SessionClass* session);
void add_trace(SessionClass* session);
void add_orders(SessionClass* session);
void add_floquet(SessionClass* session);
void add_curves(SessionClass* session);
void add_verify(SessionClass* session);
void add_tolerance(SessionClass* session);
void add_exploration(pybind11::module_* module, SessionClass* session);

}  // namespace gearsweep::python
