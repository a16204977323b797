#include "verify/verify.hpp"

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <optional>
#include <utility>

#include "core/background.hpp"
#include "core/session.hpp"

namespace gearsweep::python {
namespace {

namespace py = pybind11;

// In the order of the package's fields.
py::tuple as_row(const CheckReport& report) {
  const Outcome& outcome = report.outcome;
  return py::make_tuple(report.check->name, report.check->what, word_of(outcome.verdict),
                        report.seconds, outcome.numbers, outcome.failed, figures_of(outcome));
}

// Lets go of the GIL where this thread has it.
class WithoutGil {
 public:
  WithoutGil() {
    if (PyGILState_Check() == 1) released_.emplace();
  }

 private:
  std::optional<py::gil_scoped_release> released_;
};

// The sweeps of a check go on while others have the GIL.
Subject letting_go(Subject subject) {
  subject.compute = [compute = std::move(subject.compute)](const Study& study) {
    const WithoutGil others;
    return compute(study);
  };
  return subject;
}

CheckReport report_of(const Check& check, const Subject& subject) {
  if (!check.is_at_files) return carry_out_timed(check, subject);
  // No other thread of Python's must be at a NetCDF file.
  const py::gil_scoped_acquire alone;
  return carry_out_timed(check, subject);
}

// The device and the rows. tell: takes a row, each when it is there.
py::tuple verify(Session* session, const std::string& device, const py::object& tell) {
  SweepOptions options = session->options_for(device);
  const std::vector<DeviceInfo> devices = list_devices();
  const DeviceInfo& subject =
      devices[options.devices.empty() ? default_device(devices) : options.devices.front().number];
  Mailbox<CheckReport> reports;
  py::list rows;
  run_in_background(
      [&](const std::atomic<bool>& stop) {
        options.stop = &stop;
        const Subject tested = letting_go(make_subject(subject, options));
        for (const Check& check : checks()) {
          if (stop) return;
          reports.put(report_of(check, tested));
        }
      },
      [&] {
        for (const CheckReport& report : reports.take()) {
          rows.append(as_row(report));
          if (!tell.is_none()) tell(rows[rows.size() - 1]);
        }
      });
  return py::make_tuple(
      fmt::format("{} ({}, driver {})", subject.name, subject.platform, subject.driver), rows);
}

}  // namespace

void add_verify(SessionClass* session) {
  session->def("verify", verify, py::call_guard<Computation>(), py::arg("device"), py::arg("tell"));
}

}  // namespace gearsweep::python
