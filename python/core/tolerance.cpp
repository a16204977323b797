#include <pybind11/stl.h>

#include <optional>
#include <string>

#include "core/background.hpp"
#include "core/session.hpp"
#include "report/tolerance_report.hpp"

namespace gearsweep::python {
namespace {

namespace py = pybind11;

// The text of a JSON object. width: of the percentile's interval, as the command has it.
std::string tolerance_findings(Session* session, const Study& study, std::size_t gears,
                               int tolerance_class, double percentile, std::optional<double> width,
                               const std::string& journal, const std::string& device,
                               const std::string& call) {
  const SweepOptions sweep = session->options_for(device);
  ToleranceOptions options;
  options.devices = sweep.devices;
  options.scheduler = sweep.scheduler;
  options.gears = gears;
  options.tolerance_class = tolerance_class;
  options.percentile = percentile;
  options.width = width;
  options.journal_path = journal;
  options.command_line = call;
  std::optional<std::string> findings;
  run_in_background([&](const std::atomic<bool>& stop) {
    options.stop = &stop;
    findings = gearsweep::tolerance_findings(study, options);
  });
  return *findings;
}

}  // namespace

void add_tolerance(SessionClass* session) {
  session->def("tolerance_findings", tolerance_findings, py::call_guard<Computation>(),
               py::arg("study"), py::arg("gears"), py::arg("tolerance_class"),
               py::arg("percentile"), py::arg("width"), py::arg("journal"), py::arg("device"),
               py::arg("call"));
}

}  // namespace gearsweep::python
