#include <pybind11/stl.h>

#include "core/background.hpp"
#include "core/place.hpp"
#include "core/result.hpp"
#include "core/session.hpp"
#include "model/version.hpp"
#include "orders/order_map.hpp"
#include "point/point_trace.hpp"
#include "result/order_dataset.hpp"
#include "study/draft.hpp"

namespace gearsweep::python {
namespace {

namespace py = pybind11;

// The dataset. over, channel: empty for the usual ones.
py::tuple orders(Session* session, const Study& study, const std::string& over,
                 const NamedValues& place, const std::string& channel,
                 std::optional<std::size_t> settle, std::optional<std::size_t> record,
                 double highest, std::size_t samples_per_period, bool has_window,
                 const std::optional<FoundStep>& pilot_step, const std::string& device,
                 const std::string& call) {
  SweepOptions options = session->options_for(device);
  Study whole = with_windows(study, {settle, record});
  if (!record) whole.integrate.record = usual_order_record(whole);
  settle_step(pilot_step, &whole);
  OrderRequest request;
  request.over = over;
  request.place = find_place(whole, named(place), "");
  request.channel = channel;
  request.orders = highest;
  request.samples_per_period = samples_per_period;
  request.window = has_window ? SpectrumWindow::hann : SpectrumWindow::none;
  std::optional<OrderMap> map;
  run_in_background([&](const std::atomic<bool>& stop) {
    options.stop = &stop;
    map = map_orders(whole, request, options);
  });
  return as_tuple(dataset_of(*map, {call, version(), source_hash()}));
}

}  // namespace

void add_orders(SessionClass* session) {
  session->def("orders", orders, py::call_guard<Computation>(), py::arg("study"), py::arg("over"),
               py::arg("place"), py::arg("channel"), py::arg("settle"), py::arg("record"),
               py::arg("highest"), py::arg("samples_per_period"), py::arg("has_window"),
               py::arg("pilot_step"), py::arg("device"), py::arg("call"));
}

}  // namespace gearsweep::python
