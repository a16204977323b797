#include <pybind11/stl.h>

#include <tuple>

#include "core/background.hpp"
#include "core/place.hpp"
#include "core/result.hpp"
#include "core/session.hpp"
#include "model/version.hpp"
#include "point/point_orbit.hpp"
#include "result/orbit_dataset.hpp"

namespace gearsweep::python {
namespace {

namespace py = pybind11;

using Along = std::tuple<std::string, double, double>;  // parameter, from, to

// The dataset.
py::tuple floquet(Session* session, const Study& study, const NamedValues& place,
                  const std::optional<Along>& along, std::optional<std::size_t> period,
                  std::optional<std::size_t> steps, bool is_equilibrium, std::size_t generations,
                  const std::string& device, const std::string& call) {
  SweepOptions options = session->options_for(device);
  OrbitRequest request = {.place = find_place(study, named(place), ""),
                          .range = {},
                          .range_origin = "along",
                          .period = period,
                          .steps = steps,
                          .is_equilibrium = is_equilibrium,
                          .generations = generations};
  if (along) {
    const auto& [name, from, to] = *along;
    request.range = find_range(*study.model, name, from, to, request.range_origin);
  }
  std::optional<OrbitFindings> findings;
  run_in_background([&](const std::atomic<bool>& stop) {
    options.stop = &stop;
    findings = find_point_orbit(study, request, options);
  });
  return as_tuple(dataset_of(*findings, {call, version(), source_hash()}));
}

}  // namespace

void add_floquet(SessionClass* session) {
  session->def("floquet", floquet, py::call_guard<Computation>(), py::arg("study"),
               py::arg("place"), py::arg("along"), py::arg("period"), py::arg("steps"),
               py::arg("equilibrium"), py::arg("generations"), py::arg("device"), py::arg("call"));
}

}  // namespace gearsweep::python
