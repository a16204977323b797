#include "core/session.hpp"

#include <pybind11/stl.h>
#include <unistd.h>

#include <optional>

#include "core/background.hpp"
#include "core/parts.hpp"
#include "core/result.hpp"
#include "journal/journal.hpp"
#include "model/error.hpp"
#include "model/version.hpp"
#include "opencl/device.hpp"
#include "result/result_size.hpp"
#include "sweep/sweep.hpp"

namespace gearsweep::python {

namespace py = pybind11;

void Session::enter() {
  pid_t owner = 0;
  const pid_t self = getpid();
  if (owner_.compare_exchange_strong(owner, self) || owner == self) return;
  throw RunError(
      "gearsweep cannot compute after fork(): this process was forked from one that uses its "
      "devices, whose threads it does not have. Give multiprocessing the start method 'spawn', or "
      "fork before anything is computed");
}

SweepOptions Session::options_for(const std::string& device) {
  enter();
  SweepOptions options;
  options.scheduler = scheduler_;
  if (!device.empty()) options.devices = parse_devices(device, list_devices());
  return options;
}

namespace {

// Tells a function of Python's the latest of what is new.
void tell_latest(const std::vector<SweepProgress>& news, const py::object& progress) {
  if (news.empty() || progress.is_none()) return;
  const SweepProgress& latest = news.back();
  progress(latest.share, latest.points_done, latest.points, latest.seconds);
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
              const std::string& journal, const std::string& call, const py::object& progress,
              int priority) {
  ensure_whole(study);
  const Provenance provenance = {call, version(), source_hash()};
  SweepOptions options = session->options_for(device);
  options.journal_path = journal;
  options.priority = priority;
  options.keep_journal = true;  // until Python has the result
  options.delivery = delivery_of(study, provenance);
  Mailbox<SweepProgress> news;
  Mailbox<std::string> warnings;
  options.on_progress = [&](const SweepProgress& latest) { news.put(latest); };
  options.warn = [&](const std::string& warning) { warnings.put(warning); };
  std::optional<SweepResult> result;
  run_in_background(
      [&](const std::atomic<bool>& stop) {
        options.stop = &stop;
        result = run_sweep(study, options);
      },
      [&] { tell_latest(news.take(), progress); });
  py::tuple out = py::make_tuple(as_tuple(dataset_of(*result, provenance)), warnings.take());
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
  stop_computations_at_exit();
  SessionClass session(*module, "Session");
  session.def(py::init<>())
      .def("run", run, py::call_guard<Computation>(), py::arg("study"), py::arg("device"),
           py::arg("journal"), py::arg("call"), py::arg("progress"), py::arg("priority"))
      .def("devices", list_as_dicts);
  add_shards(module, &session);
  add_trace(&session);
  add_orders(&session);
  add_floquet(&session);
  add_curves(&session);
  add_verify(&session);
  add_tolerance(&session);
  add_exploration(module, &session);
}

}  // namespace gearsweep::python
