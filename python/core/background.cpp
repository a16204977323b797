#include "core/background.hpp"

#include <pybind11/pybind11.h>
#include <sys/types.h>
#include <unistd.h>

#include <chrono>
#include <future>
#include <thread>

namespace gearsweep::python {

namespace py = pybind11;

namespace {

// Guarded by the GIL.
struct {
  std::size_t count = 0;
  pid_t process = 0;  // whose computations are counted
  bool is_end = false;
} computations;

void throw_at_end() {
  if (!computations.is_end) return;
  PyErr_SetNone(PyExc_SystemExit);
  throw py::error_already_set();
}

void end_computations() {
  constexpr std::chrono::milliseconds kNap{5};
  computations.is_end = true;
  // A process that was forked meanwhile has none of them.
  while (computations.count > 0 && computations.process == getpid()) {
    const py::gil_scoped_release others;
    std::this_thread::sleep_for(kNap);
  }
}

}  // namespace

Computation::Computation() {
  throw_at_end();
  if (computations.process != getpid()) computations.count = 0;
  computations.process = getpid();
  ++computations.count;
}

Computation::~Computation() { --computations.count; }

void stop_computations_at_exit() {
  py::module_::import("atexit").attr("register")(py::cpp_function(end_computations));
}

void run_in_background(const std::function<void(const std::atomic<bool>& stop)>& work,
                       const std::function<void()>& meanwhile) {
  // A signal of the user's waits no longer.
  constexpr std::chrono::milliseconds kMost{50};
  std::atomic<bool> stop = false;
  std::future<void> end = std::async(std::launch::async, [&] { work(stop); });
  try {
    for (bool has_ended = false; !has_ended;) {
      {
        const py::gil_scoped_release others;
        has_ended = end.wait_for(kMost) == std::future_status::ready;
      }
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      throw_at_end();
      meanwhile();
    }
  } catch (...) {
    const py::gil_scoped_release others;
    stop = true;
    end.wait();
    throw;
  }
  end.get();
}

}  // namespace gearsweep::python
