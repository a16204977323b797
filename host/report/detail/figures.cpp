#include "report/detail/figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "orders/spectrum.hpp"
#include "plot/band.hpp"
#include "plot/plot.hpp"
#include "plot/value_range.hpp"
#include "report/detail/names.hpp"
#include "report/detail/words.hpp"
#include "result/order_dataset.hpp"
#include "result/si_units.hpp"

namespace gearsweep {
namespace {

struct SharedLimits {
  Limits x, y, colours;
};

std::optional<std::string> words_at_axis(const ReportFindings& findings,
                                         const FigureRequest& request) {
  if (request.words) return request.words;
  if (request.quantity.empty()) return signal_words(findings.orders.channel);
  return model_words(*findings.study.model, request.quantity, findings.count_of(request.quantity));
}

PlotRequest plot_request(const ReportFindings& findings, const FigureRequest& request,
                         const SharedLimits& limits) {
  PlotRequest plot;
  for (const std::string& file : request.files) plot.paths.push_back(findings.file(file));
  plot.quantity = request.quantity;
  plot.output_path = findings.file(request.name + ".svg");
  plot.style.has_units = true;
  plot.style.is_si = findings.is_si();
  plot.style.title = "";
  plot.style.words = words_at_axis(findings, request);
  plot.style.legend = request.legend;
  plot.style.size = {HtmlPage::kFigureWidth, request.height, false};
  plot.style.xrange = limits.x;
  plot.style.yrange = limits.y;
  plot.style.range = limits.colours;
  return plot;
}

HtmlFigure plotted(const ReportFindings& findings, const PlotRequest& request,
                   const std::string& caption) {
  plot_files(request);
  return {request.output_path,
          findings.name.empty() ? caption
                                : fmt::format("<b>{}</b>: {}", html_text(findings.name), caption)};
}

void widen(const std::vector<double>& values, Limits* limits) {
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    limits->min = std::min(limits->min.value_or(value), value);
    limits->max = std::max(limits->max.value_or(value), value);
  }
}

Limits limits_of(const ValueRange& range) { return {range.min, range.max}; }

// The ends of the band around a curve, where it has one.
void append_band(const ReportFindings& findings, const std::string& file,
                 const std::string& quantity, std::vector<double>* values) {
  const std::optional<BandMaps> band =
      band_maps(quantity, ResultFile(findings.file(file)).quantities());
  if (!band) return;
  for (const std::string& end : {band->low, band->high}) {
    const std::vector<double> own = findings.over_speed(file, end).values;
    values->insert(values->end(), own.begin(), own.end());
  }
}

// From the lowest to the highest of all sides; nothing of one side alone, whose axes suit it.
SharedLimits shared_limits(const Sides& sides, const FigureRequest& request) {
  SharedLimits shared;
  if (sides.size() < 2) return shared;
  std::vector<double> values;
  bool has_classes = false;
  for (const ReportFindings& findings : sides) {
    for (const std::string& file : request.files) {
      const ResultMap map = request.is_map ? findings.map(file, request.quantity)
                                           : findings.over_speed(file, request.quantity);
      has_classes = has_classes || !map.flags.empty();
      values.insert(values.end(), map.values.begin(), map.values.end());
      append_band(findings, file, request.quantity, &values);
      widen(map.axes[0].values, &shared.x);
      if (request.is_map) widen(map.axes[1].values, &shared.y);
    }
  }
  if (has_classes) return shared;
  (request.is_map ? shared.colours : shared.y) =
      limits_of(request.is_map ? colour_range(values) : padded_range(values));
  return shared;
}

// So that all natural frequencies and four orders of the fastest speed are seen.
double highest_frequency(const ReportFindings& findings) {
  constexpr double kOrders = 4.0, kRoom = 1.1;
  const OrderMap& orders = findings.orders;
  double highest = kOrders * *std::ranges::max_element(orders.forcing);
  for (const NaturalMode& mode : orders.modes.front()) {
    highest = std::max(highest, kRoom * mode.frequency);
  }
  return findings.is_si() ? highest * hertz_per_unit(findings.study.scales) : highest;
}

SharedLimits shared_order_limits(const Sides& sides) {
  constexpr double kDepth = 80.0, kRound = 10.0;  // dB
  SharedLimits shared;
  if (sides.size() < 2) return shared;
  double largest = 0.0, highest = 0.0;
  for (const ReportFindings& findings : sides) {
    const SiUnit unit = shown_unit(findings.orders.channel.unit, findings.study.scales);
    const double scale = unit.scale > 0.0 ? unit.scale : 1.0;
    for (const double amplitude : findings.orders.amplitude) {
      if (std::isfinite(amplitude)) largest = std::max(largest, amplitude * scale);
    }
    highest = std::max(highest, highest_frequency(findings));
    widen(findings.over_speed("line.nc", findings.force).axes[0].values, &shared.x);
  }
  const double top = kRound * std::ceil(decibels(std::max(largest, 1e-300)) / kRound);
  shared.colours = {top - kDepth, top};
  shared.y = {0.0, highest};
  return shared;
}

}  // namespace

std::vector<HtmlFigure> figures_of(const Sides& sides, const FigureRequest& request,
                                   const std::string& caption) {
  const SharedLimits limits = shared_limits(sides, request);
  std::vector<HtmlFigure> figures;
  for (const ReportFindings& findings : sides) {
    PlotRequest plot = plot_request(findings, request, limits);
    if (!request.is_map) plot.at = findings.at;
    figures.push_back(
        plotted(findings, plot, request.is_map ? caption + "." : caption_of(caption, findings)));
  }
  return figures;
}

std::vector<HtmlFigure> order_figures(const Sides& sides, const std::string& caption) {
  const SharedLimits limits = shared_order_limits(sides);
  FigureRequest request = {"orders", {"orders.nc"}, ""};
  request.height = kFigureHeightWithKey;
  std::vector<HtmlFigure> figures;
  for (const ReportFindings& findings : sides) {
    figures.push_back(
        plotted(findings, plot_request(findings, request, limits), caption_of(caption, findings)));
  }
  return figures;
}

}  // namespace gearsweep
