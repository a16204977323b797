#include "core/background.hpp"

#include <pybind11/pybind11.h>

#include <chrono>
#include <future>

namespace gearsweep::python {

namespace py = pybind11;

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
