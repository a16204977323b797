#include <pybind11/stl.h>

#include <algorithm>

#include "borders/border_search.hpp"
#include "core/background.hpp"
#include "core/result.hpp"
#include "core/session.hpp"
#include "model/error.hpp"
#include "model/version.hpp"
#include "point/point_trace.hpp"
#include "result/border_file.hpp"

namespace gearsweep::python {
namespace {

namespace py = pybind11;

// The dataset; nothing of it is kept when stopped. period, contact: [iy * nx + ix] over the study's
// two axes; contact may be empty.
py::tuple curves(Session* session, const Study& study, std::vector<double> period,
                 std::vector<double> contact, std::size_t steps, std::size_t min_pairs,
                 const std::optional<FoundStep>& pilot_step, const std::string& device,
                 const std::string& call) {
  SweepOptions options = session->options_for(device);
  Study whole = study;
  settle_step(pilot_step, &whole);
  if (whole.axes.size() != 2) throw InputError("curves take a map of two axes");
  BorderRequest request;
  for (std::size_t i = 0; i < 2; ++i) {
    request.pixels.axes[i] = whole.axes[i].values;
    request.pixels.is_logarithmic[i] = whole.axes[i].logarithmic;
  }
  const std::size_t pixels = whole.axes[0].values.size() * whole.axes[1].values.size();
  if (period.size() != pixels || (!contact.empty() && contact.size() != pixels)) {
    throw InputError("the map has other points than its study: curves take a whole map");
  }
  request.pixels.period = std::move(period);
  request.pixels.contact = std::move(contact);
  request.steps = steps;
  request.min_edges = min_pairs;
  std::optional<BorderFindings> findings;
  run_in_background([&](const std::atomic<bool>& stop) {
    options.stop = &stop;
    findings = find_borders(whole, request, options);
  });
  return as_tuple(dataset_of(*findings, {call, version(), source_hash()}));
}

}  // namespace

void add_curves(SessionClass* session) {
  session->def("curves", curves, py::call_guard<Computation>(), py::arg("study"), py::arg("period"),
               py::arg("contact"), py::arg("steps"), py::arg("min_pairs"), py::arg("pilot_step"),
               py::arg("device"), py::arg("call"));
}

}  // namespace gearsweep::python
