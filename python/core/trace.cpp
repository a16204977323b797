#include <pybind11/stl.h>

#include "core/background.hpp"
#include "core/place.hpp"
#include "core/result.hpp"
#include "core/session.hpp"
#include "model/version.hpp"
#include "point/point_trace.hpp"

namespace gearsweep::python {
namespace {

namespace py = pybind11;

// The dataset, and what a user must be told. points: one trace each.
py::tuple trace(Session* session, const Study& study, const std::vector<NamedValues>& points,
                std::optional<std::size_t> settle, std::optional<std::size_t> record,
                std::size_t samples_per_period, const std::optional<FoundStep>& pilot_step,
                const std::string& device, const std::string& call) {
  SweepOptions options = session->options_for(device);
  Study whole = with_windows(study, {settle, record});
  settle_step(pilot_step, &whole);
  std::vector<Place> places;
  for (const NamedValues& point : points) {
    places.push_back(find_place(whole, named(point), ""));
  }
  PointTraces found;
  run_in_background([&](const std::atomic<bool>& stop) {
    options.stop = &stop;
    for (const Place& place : places) {
      const bool is_done =
          add_point_trace(whole, place, {settle, record}, samples_per_period, options, &found);
      if (!is_done) return;
    }
  });
  return py::make_tuple(as_tuple(dataset_of(found.traces, found.labels, found.placed, whole,
                                            {call, version(), source_hash()})),
                        found.notices);
}

}  // namespace

void add_trace(SessionClass* session) {
  session->def("trace", trace, py::call_guard<Computation>(), py::arg("study"), py::arg("points"),
               py::arg("settle"), py::arg("record"), py::arg("samples_per_period"),
               py::arg("pilot_step"), py::arg("device"), py::arg("call"));
}

}  // namespace gearsweep::python
