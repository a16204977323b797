#include <pybind11/stl.h>

#include <atomic>
#include <optional>
#include <thread>

#include "core/parts.hpp"
#include "core/session.hpp"
#include "explore/server.hpp"

namespace gearsweep::python {
namespace {

namespace py = pybind11;

// Serves on a thread of its own, which knows no Python.
class Exploration {
 public:
  Exploration(const Study& study, const std::optional<FoundStep>& pilot_step,
              const std::string& source, SweepOptions options, std::size_t megabytes, int port)
      : explorer_({explorable(study), pilot_step, study.axes.size() == 1},
                  {.source = source,
                   .is_model = false,
                   .devices = std::move(options.devices),
                   .max_bytes = megabytes << 20U}),
        server_(&explorer_, port) {}

  const std::string& address() const { return server_.address(); }
  bool is_running() const { return thread_.joinable(); }
  void stop() {
    stop_ = true;
    if (thread_.joinable()) thread_.join();
  }

 private:
  Explorer explorer_;
  ExploreServer server_;
  std::atomic<bool> stop_ = false;
  std::jthread thread_{[this] { server_.serve(stop_); }};
};

}  // namespace

void add_exploration(py::module_* module, SessionClass* session) {
  py::class_<Exploration>(*module, "Exploration")
      .def_property_readonly("address", &Exploration::address)
      .def_property_readonly("is_running", &Exploration::is_running)
      .def("stop", &Exploration::stop, py::call_guard<py::gil_scoped_release>());
  session->def(
      "explore",
      [](Session* self, const Study& study, const std::optional<FoundStep>& pilot_step,
         const std::string& source, const std::string& device, std::size_t megabytes, int port) {
        return std::make_unique<Exploration>(study, pilot_step, source, self->options_for(device),
                                             megabytes, port);
      },
      py::arg("study"), py::arg("pilot_step"), py::arg("source"), py::arg("device"),
      py::arg("megabytes"), py::arg("port"));
}

}  // namespace gearsweep::python
