#include <pybind11/stl.h>
#include <unistd.h>

#include <atomic>
#include <memory>

#include "core/background_sweep.hpp"
#include "core/parts.hpp"
#include "core/result.hpp"
#include "journal/journal.hpp"
#include "model/error.hpp"
#include "model/version.hpp"
#include "opencl/device.hpp"
#include "result/result_size.hpp"

namespace gearsweep::python {
namespace {

namespace py = pybind11;

// The devices of a process, which stay open with all kernels that were built for them: a run that
// is like an earlier one begins at once.
class Session {
 public:
  // Throws RunError in a process that has been forked from one that uses devices.
  void enter() {
    pid_t owner = 0;
    const pid_t self = getpid();
    if (owner_.compare_exchange_strong(owner, self) || owner == self) return;
    throw RunError(
        "gearsweep cannot compute after fork(): this process was forked from one that uses its "
        "devices, whose threads it does not have. Give multiprocessing the start method 'spawn', "
        "or "
        "fork before anything is computed");
  }

  const std::shared_ptr<OpenDevices>& devices() const { return devices_; }

 private:
  std::atomic<pid_t> owner_ = 0;  // the process that uses the devices; 0: none yet
  const std::shared_ptr<OpenDevices> devices_ = std::make_shared<OpenDevices>();
};

// Tells Python what is new. Throws what it raises, for instance after Ctrl-C.
void tell_python(BackgroundSweep* sweep, const py::object& progress) {
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  const std::optional<SweepProgress> news = sweep->progress();
  if (!news || progress.is_none()) return;
  progress(news->share, news->points_done, news->points, news->seconds);
}

void wait_for(BackgroundSweep* sweep, const py::object& progress) {
  // A signal of the user's waits no longer.
  constexpr std::chrono::milliseconds kMost{50};
  for (bool has_ended = false; !has_ended;) {
    {
      const py::gil_scoped_release others;
      has_ended = sweep->wait(kMost);
    }
    tell_python(sweep, progress);
  }
}

// A draft is what Python builds studies from.
void ensure_whole(const Study& study) {
  if (!study.axes.empty()) return;
  throw InputError(
      "the study has no axes, so there is nothing to sweep; give it one or two, as in "
      "study.sweep(omega=(0.4, 2.0, 100))");
}

// What the arrays take, those of the file and those that xarray makes of them.
DeliveryEstimate delivery_of(const Study& study, const Provenance& provenance) {
  constexpr double kCopies = 3.0;
  return {0.0, kCopies * size_of_result(study, provenance).file};
}

// The dataset, and what went wrong meanwhile.
py::tuple run(Session* session, const Study& study, const std::string& device,
              const std::string& journal, const std::string& call, const py::object& progress) {
  ensure_whole(study);
  session->enter();
  const Provenance provenance = {call, version(), source_hash()};
  SweepOptions options;
  options.open = session->devices();
  options.journal_path = journal;
  options.keep_journal = true;  // until Python has the result
  options.delivery = delivery_of(study, provenance);
  if (!device.empty()) options.devices = parse_devices(device, list_devices());
  BackgroundSweep sweep(study, std::move(options));
  try {
    wait_for(&sweep, progress);
  } catch (...) {
    {
      const py::gil_scoped_release others;
      sweep.finish();
    }
    throw;
  }
  const SweepResult result = sweep.take();
  py::tuple out = py::make_tuple(as_tuple(dataset_of(result, provenance)), sweep.troubles());
  if (!journal.empty()) Journal::discard(journal);
  return out;
}

py::list list_as_dicts(Session* session) {
  session->enter();
  py::list out;
  for (const DeviceInfo& device : list_devices()) {
    py::dict row;
    row["number"] = out.size();
    row["name"] = device.name;
    row["platform"] = device.platform;
    row["driver"] = device.driver;
    row["kind"] = device.is_cpu ? "cpu" : "gpu";
    row["compute_units"] = device.compute_units;
    row["fp64"] = device.fp64;
    out.append(row);
  }
  return out;
}

}  // namespace

void add_session(py::module_* module) {
  py::class_<Session>(*module, "Session")
      .def(py::init<>())
      .def("run", run, py::arg("study"), py::arg("device"), py::arg("journal"), py::arg("call"),
           py::arg("progress"))
      .def("devices", list_as_dicts);
}

}  // namespace gearsweep::python
