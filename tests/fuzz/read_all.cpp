#include "fuzz/read_all.hpp"

#include <functional>
#include <stdexcept>

#include "fuzz/targets.hpp"
#include "model/error.hpp"
#include "plot/detail/sources.hpp"
#include "result/border_file.hpp"
#include "result/border_plane.hpp"
#include "result/export.hpp"
#include "result/order_dataset.hpp"
#include "result/peaks.hpp"
#include "result/result_file.hpp"
#include "result/trace_file.hpp"

namespace gearsweep::testing {
namespace {

void attempt(const std::function<void()>& action) {
  try {
    action();
  } catch (const InputError&) {
  } catch (const RunError&) {
  }
}

PlotRequest request_for(const std::string& path, const std::string& quantity) {
  PlotRequest request;
  request.paths = {path};
  request.quantity = quantity;
  request.output_path = "picture.png";
  return request;
}

// A map that was read holds what it says that it holds.
void check_whole(const ResultMap& map) {
  if (map.values.size() != map.points() * map.part_count() * map.samples) {
    throw std::logic_error("the map '" + map.name + "' has not the size that it says");
  }
  map.column_names();
}

// Opening a file takes most of the time, so what opens it anew is asked for one quantity only.
void read_maps(const std::string& path) {
  const ResultFile file(path);
  attempt([&] { file.title(), file.study_text(); });
  attempt([&] { file.poincare_states(); });
  for (const std::string& name : file.quantities()) {
    attempt([&] { check_whole(file.read(name)); });
    attempt([&] { check_whole(file.read(name + ":1")); });
    for (const ResultAxis& axis : file.axes()) {
      attempt([&] { check_whole(file.read(name, file.find_cut(axis.name, 1.0))); });
    }
  }
  const std::string last = file.quantities().empty() ? "" : file.quantities().back();
  const ResultAxis& axis = file.axes().back();
  PlotRequest cut = request_for(path, last);
  cut.at = {axis.name, axis.values.front()};
  attempt([&] { plot_maps(Page({}, PictureFormat::kPdf), cut); });
  cut.quantity += ",status";
  attempt([&] { plot_maps(Page({}, PictureFormat::kPdf), cut); });
  attempt([&] { plot_maps(Page({}, PictureFormat::kPdf), request_for(path, "")); });
  attempt([&] { export_maps(path, {last}, path + ".csv"); });
  attempt([&] { export_maps(path, {last}, path + ".npy"); });
  attempt([&] { export_maps(path, {}, path + ".csv"); });
  attempt([&] {
    const ResultMap map = file.read(last);
    if (map.values.size() == map.points()) find_peaks(map, {});
  });
}

void read_all_traces(const std::string& path) {
  read_traces(path);
  for (const char* kind : {"time", "phase", "section", "spectrum", "force", "portrait"}) {
    attempt([&] { plot_traces(Page({}, PictureFormat::kPdf), request_for(path, kind)); });
  }
}

void read_all_orders(const std::string& path) {
  read_orders(path);
  for (const char* upright : {"frequency", "order"}) {
    attempt([&] { plot_orders(request_for(path, upright)); });
  }
}

}  // namespace

void read_all_of(const std::string& path) {
  attempt([&] { read_hostile_study(read_study_text(path)); });
  attempt([&] { read_pilot_step(path); });
  attempt([&] { read_border_study(path, read_borders(path)); });
  attempt([&] { read_maps(path); });
  attempt([&] {
    if (is_trace_file(path)) read_all_traces(path);
  });
  attempt([&] {
    if (is_order_file(path)) read_all_orders(path);
  });
}

}  // namespace gearsweep::testing
