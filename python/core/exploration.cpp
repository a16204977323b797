#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <atomic>
#include <optional>
#include <string>
#include <thread>
#include <tuple>
#include <utility>
#include <vector>

#include "core/parts.hpp"
#include "core/session.hpp"
#include "explore/explored_curves.hpp"
#include "explore/server.hpp"
#include "result/broken_file.hpp"

namespace gearsweep::python {
namespace {

namespace py = pybind11;

using ColumnsOfTexts = std::vector<std::pair<std::string, std::vector<std::string>>>;
using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;

// A Dataset of curves: its study, its attributes that are texts, steps_per_period, its variables.
using GivenCurves = std::tuple<Study, std::vector<std::pair<std::string, std::string>>, double,
                               ColumnsOfTexts, std::vector<std::pair<std::string, Numbers>>>;

ExploredCurves curves_of(const GivenCurves& given, const Study& study) {
  const auto& [of_curves, notes, steps, texts, numbers] = given;
  BorderTable table;
  table.notes.insert(notes.begin(), notes.end());
  table.steps = steps;
  table.texts.insert(texts.begin(), texts.end());
  for (const auto& [name, array] : numbers) {
    table.numbers[name] = {{array.shape(), array.shape() + array.ndim()},
                           {array.data(), array.data() + array.size()}};
  }
  return explored_curves(read_borders(table, "curves"), of_curves, study, "curves");
}

// Whatever the page shows. With the GIL, as no other thread must be at a file.
ExplorerOptions options_of(const Study& study, const std::string& source, const SweepOptions& sweep,
                           std::size_t megabytes, const std::string& curves_path,
                           const std::optional<GivenCurves>& curves) {
  ExplorerOptions options;
  options.source = source;
  options.is_model = false;
  options.devices = sweep.devices;
  options.max_bytes = megabytes << 20U;
  if (curves) options.curves = curves_of(*curves, study);
  if (!curves_path.empty()) {
    ensure_not_broken(curves_path);
    options.curves = read_explored_curves(curves_path, study, "curves");
  }
  return options;
}

// Serves on a thread of its own, which knows no Python.
class Exploration {
 public:
  Exploration(const Study& study, const std::optional<FoundStep>& pilot_step,
              ExplorerOptions options, int port)
      : explorer_({explorable(study), pilot_step, study.axes.size() == 1}, std::move(options)),
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
         const std::string& source, const std::string& device, std::size_t megabytes, int port,
         const std::string& curves_path, const std::optional<GivenCurves>& curves) {
        return std::make_unique<Exploration>(
            study, pilot_step,
            options_of(explorable(study), source, self->options_for(device), megabytes, curves_path,
                       curves),
            port);
      },
      py::arg("study"), py::arg("pilot_step"), py::arg("source"), py::arg("device"),
      py::arg("megabytes"), py::arg("port"), py::arg("curves_path"), py::arg("curves"));
}

}  // namespace gearsweep::python
