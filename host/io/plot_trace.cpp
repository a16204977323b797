#include "io/plot_trace.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/plot_scale.hpp"
#include "io/plot_text.hpp"
#include "io/spectrum.hpp"

namespace gearsweep {
namespace {

// The values at phase 0, over those of `across`.
struct Section {
  std::vector<double> x, y;
};

Section section_of(const TracePicture& picture, const Trace& trace) {
  // Far less than a step, far more than the rounding of tau.
  constexpr double kInstant = 1e-6;
  const std::vector<double> time = periods_of(trace);
  const std::vector<double>& x = values_of(trace, picture.across.name);
  const std::vector<double>& y = values_of(trace, picture.channel.name);
  Section section;
  double last = -1.0;  // a step that ends there and one that begins there are one moment
  for (std::size_t i = 0; i < time.size(); ++i) {
    const double period = std::round(time[i]);
    if (std::abs(time[i] - period) > kInstant || period == last) continue;
    section.x.push_back(x[i]);
    section.y.push_back(y[i]);
    last = period;
  }
  return section;
}

// The dots of a layer, which stand out by a dark rim where they are few or lie over curves.
void add_section(const TracePicture& picture, std::size_t layer, bool over_curves,
                 PlotScript* script) {
  constexpr std::size_t kFew = 100;
  const Section section = section_of(picture, picture.layers[layer].trace);
  const bool few = section.x.size() <= kFew;
  const std::string data = next_records(*script, section.x.size(), 2);
  if (few || over_curves) {
    script->text += fmt::format(
        "{} using 1:2 with points pointtype 7 pointsize dot*{} linecolor rgb '#000000' notitle, "
        "\\\n"
        "     ",
        data, few ? 1.5 : 0.9);
  }
  script->text += fmt::format(
      "{} using 1:2 with points pointtype 7 pointsize dot*{} linecolor rgb '{}' notitle", data,
      few ? 1.1 : 0.4, layer_colour(layer));
  for (std::size_t i = 0; i < section.x.size(); ++i) {
    append_numbers({section.x[i], section.y[i]}, &script->data);
  }
}

AxisRange shown_range(const ValueRange& range, const Limits& limits, const std::string& option) {
  const ValueRange own = limited(range, limits, option);
  return {own.least, own.greatest, false};
}

PanelAxis across_axis(const Page& page, const TracePicture& picture, const ValueRange& range) {
  return {{quantity_label(picture.across.name, picture.across.unit)},
          shown_range(range, page.style().xrange, "--xrange")};
}

// Of a section, but not so narrow that an orbit's rounding would fill it.
ValueRange section_range(const std::vector<double>& section, const std::vector<double>& trace) {
  constexpr double kNarrowest = 0.02;  // of the whole motion
  ValueRange range = padded_range(section);
  const ValueRange whole = padded_range(trace);
  const double least = kNarrowest * (whole.greatest - whole.least);
  const double more = 0.5 * std::max(0.0, least - (range.greatest - range.least));
  return {range.least - more, range.greatest + more};
}

// Velocities are called after their positions, so these say it all.
std::string pair_text(const TracePicture& picture) {
  if (picture.channel.meaning.find(picture.across.name) != std::string::npos) {
    return picture.across.meaning;
  }
  return fmt::format("{}; {}", picture.across.meaning, picture.channel.meaning);
}

}  // namespace

int find_channel(const Trace& trace, const std::string& name) {
  const auto found = std::find_if(trace.channels.begin(), trace.channels.end(),
                                  [&](const ChannelInfo& channel) { return channel.name == name; });
  return found == trace.channels.end() ? -1 : static_cast<int>(found - trace.channels.begin());
}

const std::vector<double>& values_of(const Trace& trace, const std::string& name) {
  return trace.values.at(static_cast<std::size_t>(find_channel(trace, name)));
}

std::vector<double> all_values(const TracePicture& picture, const std::string& name) {
  std::vector<double> all;
  for (const TraceLayer& layer : picture.layers) {
    const std::vector<double>& own = values_of(layer.trace, name);
    all.insert(all.end(), own.begin(), own.end());
  }
  return all;
}

std::vector<double> periods_of(const Trace& trace) {
  std::vector<double> periods;
  for (const double tau : trace.tau) periods.push_back(tau / trace.period);
  return periods;
}

double last_period(const TracePicture& picture) {
  double last = 0.0;
  for (const TraceLayer& layer : picture.layers) {
    if (!layer.trace.tau.empty())
      last = std::max(last, layer.trace.tau.back() / layer.trace.period);
  }
  // The even moments of a period end before the next begins.
  constexpr double kNearly = 0.1;
  return std::ceil(last) - last < kNearly ? std::ceil(last) : last;
}

std::vector<KeyEntry> layer_entries(const TracePicture& picture, KeyEntry::Kind kind) {
  std::vector<KeyEntry> entries;
  for (std::size_t i = 0; i < picture.layers.size() && picture.layers.size() > 1; ++i) {
    entries.push_back({kind, layer_colour(i), layer_dashes(i), picture.layers[i].name});
  }
  return entries;
}

PanelAxis time_axis(const Page& page, const TracePicture& picture) {
  return {{fmt::format("time ({} periods)", picture.forcing)},
          shown_range({0.0, last_period(picture)}, page.style().xrange, "--xrange")};
}

PanelAxis channel_axis(const Page& page, const TracePicture& picture, const ValueRange& range) {
  return {{quantity_label(picture.channel.name, picture.channel.unit)},
          shown_range(range, page.style().yrange, "--yrange")};
}

void finish_trace(const Page& page, const TracePicture& picture, const std::string& subtitle,
                  const std::vector<KeyEntry>& key, PanelAxis x, PanelAxis y,
                  const std::string& lines, PlotScript* script) {
  constexpr double kAspect = 0.7;
  const double em = page.em();
  const PlotStyle& style = page.style();
  const auto label = [&](const std::optional<std::string>& given, const std::string& own,
                         double length) {
    return label_lines(page, given ? literal(*given) : own, length);
  };
  x.label = label(style.xlabel, x.label.front(), page.width());
  script->height = page.height_or(kAspect * page.width() + key_height(page, key));
  const std::vector<std::string> heading =
      heading_lines(page, picture.title, subtitle, picture.remark);
  Frame frame;
  frame.bottom = key_height(page, key) + bottom_room(page, x);
  frame.top =
      script->height - (heading.empty() ? 0.7 * em : heading_height(page, heading) + 0.3 * em);
  y.label = label(style.ylabel, y.label.front(), frame.height());
  frame.left = left_room(page, y, frame.height());
  frame.right = page.width() - edge_room(page);
  ensure_room(frame, page);
  script->text = "set multiplot\n" + panel_lines(page, frame, script->height, x, y) +
                 draw_heading(page, heading, frame, script->height) +
                 draw_key(page, key, script->height) + lines + "plot " + script->text +
                 "\nunset multiplot\n";
}

void add_histories(const TracePicture& picture, PlotScript* script) {
  for (std::size_t i = 0; i < picture.layers.size(); ++i) {
    const TraceLayer& layer = picture.layers[i];
    const std::vector<double> time = periods_of(layer.trace);
    const std::vector<double>& values = values_of(layer.trace, picture.channel.name);
    script->text +=
        fmt::format("{}{} using 1:2 with lines linewidth 2 {} notitle", i == 0 ? "" : ", \\\n     ",
                    next_records(*script, time.size(), 2), layer_line(i));
    for (std::size_t moment = 0; moment < time.size(); ++moment) {
      append_numbers({time[moment], values[moment]}, &script->data);
    }
  }
}

PlotScript draw_time(const Page& page, const TracePicture& picture) {
  const ValueRange range = padded_range(all_values(picture, picture.channel.name));
  PlotScript script;
  add_histories(picture, &script);
  finish_trace(page, picture, picture.channel.meaning,
               layer_entries(picture, KeyEntry::Kind::kLine), time_axis(page, picture),
               channel_axis(page, picture, range), grid_lines(), &script);
  return script;
}

PlotScript draw_phase(const Page& page, const TracePicture& picture) {
  constexpr double kManyTurns = 40.0;  // that would run together
  const double width = last_period(picture) > kManyTurns ? 0.7 : 1.6;
  PlotScript script;
  for (std::size_t i = 0; i < picture.layers.size(); ++i) {
    const Trace& trace = picture.layers[i].trace;
    const std::vector<double>& x = values_of(trace, picture.across.name);
    const std::vector<double>& y = values_of(trace, picture.channel.name);
    script.text += fmt::format("{} using 1:2 with lines linewidth {} {} notitle, \\\n     ",
                               next_records(script, x.size(), 2), width, layer_line(i));
    for (std::size_t moment = 0; moment < x.size(); ++moment) {
      append_numbers({x[moment], y[moment]}, &script.data);
    }
  }
  for (std::size_t i = 0; i < picture.layers.size(); ++i) {
    if (i > 0) script.text += ", \\\n     ";
    add_section(picture, i, true, &script);
  }
  std::vector<KeyEntry> key = layer_entries(picture, KeyEntry::Kind::kLine);
  key.push_back({KeyEntry::Kind::kDot, "#000000", "1", "phase 0"});
  finish_trace(page, picture, pair_text(picture), key,
               across_axis(page, picture, padded_range(all_values(picture, picture.across.name))),
               channel_axis(page, picture, padded_range(all_values(picture, picture.channel.name))),
               "", &script);
  return script;
}

PlotScript draw_section(const Page& page, const TracePicture& picture) {
  std::vector<double> x, y;
  for (const TraceLayer& layer : picture.layers) {
    const Section section = section_of(picture, layer.trace);
    x.insert(x.end(), section.x.begin(), section.x.end());
    y.insert(y.end(), section.y.begin(), section.y.end());
  }
  PlotScript script;
  for (std::size_t i = 0; i < picture.layers.size(); ++i) {
    if (i > 0) script.text += ", \\\n     ";
    add_section(picture, i, false, &script);
  }
  finish_trace(
      page, picture, pair_text(picture) + ", at phase 0 of each period",
      layer_entries(picture, KeyEntry::Kind::kDot),
      across_axis(page, picture, section_range(x, all_values(picture, picture.across.name))),
      channel_axis(page, picture, section_range(y, all_values(picture, picture.channel.name))), "",
      &script);
  return script;
}

PlotScript draw_spectrum(const Page& page, const TracePicture& picture) {
  constexpr double kShown = 100.0, kAbove = 5.0;  // dB
  constexpr double kLeast = 1e-300;               // of an amplitude that has a logarithm
  PlotScript script;
  double greatest = kLeast;
  for (std::size_t i = 0; i < picture.layers.size(); ++i) {
    const Trace& trace = picture.layers[i].trace;
    const int channel = find_channel(trace, picture.channel.name);
    const Spectrum spectrum = amplitude_spectrum(trace, static_cast<std::size_t>(channel), 0);
    script.text += fmt::format("{}{} using 1:2 with lines linewidth 1.6 {} notitle",
                               i == 0 ? "" : ", \\\n     ",
                               next_records(script, spectrum.amplitude.size(), 2), layer_line(i));
    for (std::size_t bin = 0; bin < spectrum.amplitude.size(); ++bin) {
      const double order = static_cast<double>(bin) * spectrum.order_step;
      const double amplitude = std::max(spectrum.amplitude[bin], kLeast);
      append_numbers({order, decibels(amplitude)}, &script.data);
      if (order <= picture.orders) greatest = std::max(greatest, amplitude);
    }
  }
  const std::string unit =
      picture.channel.unit == "1" || picture.channel.unit.empty() ? "" : " " + picture.channel.unit;
  const PanelAxis x = {{fmt::format("order (frequency / {} frequency)", picture.forcing)},
                       shown_range({0.0, picture.orders}, page.style().xrange, "--xrange")};
  const PanelAxis y = {
      {fmt::format("{} (dB re 1{})", quantity_label(picture.channel.name, ""), typeset(unit))},
      shown_range({decibels(greatest) + kAbove - kShown, decibels(greatest) + kAbove},
                  page.style().yrange, "--yrange")};
  finish_trace(page, picture, "amplitudes: " + picture.channel.meaning + ", without its mean",
               layer_entries(picture, KeyEntry::Kind::kLine), x, y, grid_lines(), &script);
  return script;
}

}  // namespace gearsweep
