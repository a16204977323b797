// The panel of a spectrum.
#include "orders/spectrum.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "plot/detail/scale.hpp"
#include "plot/detail/text.hpp"
#include "plot/detail/trace.hpp"

namespace gearsweep {
namespace {

// What an order is divided by: one of the forcing has no unit, another one is a frequency.
double unit_of_orders(const Trace& trace) { return trace.is_clockless ? trace.period : 1.0; }

// Upright lines at the orders of a second mesh.
void add_other_orders(const TracePicture& picture, TracePanel* panel, PlotScript* script) {
  constexpr std::size_t kMost = 40;
  if (picture.meshes.size() < 2) return;
  const ExcitingMesh& other = picture.meshes.back();
  const AxisRange &x = panel->x.range, &y = panel->y.range;
  std::vector<double> places;
  for (std::size_t k = 1; k <= kMost; ++k) {
    const double place = static_cast<double>(k) * other.order;
    if (place >= x.min && place <= x.max) places.push_back(place);
  }
  if (places.empty()) return;
  panel->elements += fmt::format(
      ", \\\n     {} using 1:2:3:4 with vectors nohead linewidth 1 dashtype {} linecolor rgb '{}' "
      "notitle",
      next_records(*script, places.size(), 4), kOtherMeshDashes, kOtherMeshColour);
  for (const double place : places) {
    append_numbers({place, y.min, 0.0, y.max - y.min}, &script->data);
  }
  panel->key.push_back({KeyEntry::Kind::kThinLine, kOtherMeshColour, kOtherMeshDashes,
                        "orders of " + literal(other.name)});
}

}  // namespace

TracePanel spectrum_panel(const Page& page, const TracePicture& picture, PlotScript* script) {
  constexpr double kShown = 100.0, kAbove = 5.0;  // dB
  constexpr double kMin = 1e-300;                 // of an amplitude that has a logarithm
  TracePanel panel;
  panel.kind = "spectrum";
  double max = kMin;
  for (std::size_t i = 0; i < picture.layers.size(); ++i) {
    const Trace& trace = picture.layers[i].trace;
    const int channel = find_channel(trace, picture.channel.name);
    const Spectrum spectrum = amplitude_spectrum(trace, static_cast<std::size_t>(channel), 0);
    panel.elements += fmt::format(
        "{}{} using 1:2 with lines linewidth 1.6 {} notitle", i == 0 ? "" : ", \\\n     ",
        next_records(*script, spectrum.amplitude.size(), 2), layer_line(i));
    for (std::size_t bin = 0; bin < spectrum.amplitude.size(); ++bin) {
      const double order = static_cast<double>(bin) * spectrum.order_step;
      const double amplitude = std::max(spectrum.amplitude[bin], kMin);
      append_numbers({order / unit_of_orders(trace), decibels(amplitude)}, &script->data);
      if (order <= picture.orders) max = std::max(max, amplitude);
    }
  }
  const std::string unit =
      picture.channel.unit == "1" || picture.channel.unit.empty() ? "" : " " + picture.channel.unit;
  panel.subtitle = "amplitudes: " + picture.channel.meaning + ", without its mean";
  const std::string label =
      picture.is_clockless
          ? "frequency (1/time)"
          : fmt::format(
                "order (frequency / {} frequency{})", picture.forcing,
                picture.meshes.size() < 2 ? "" : " of " + literal(picture.meshes.front().name));
  const double last = picture.orders / unit_of_orders(picture.layers.front().trace);
  panel.x = {axis_text(page.style().xlabel, label),
             shown_range({0.0, last}, page.style().xrange, "--xrange")};
  panel.y = {
      axis_text(page.style().ylabel,
                fmt::format("{} (dB re 1{})",
                            channel_label({picture.channel.name, "1", picture.channel.meaning}),
                            typeset(unit))),
      shown_range({decibels(max) + kAbove - kShown, decibels(max) + kAbove}, page.style().yrange,
                  "--yrange")};
  panel.lines = grid_lines();
  add_other_orders(picture, &panel, script);
  return panel;
}

}  // namespace gearsweep
