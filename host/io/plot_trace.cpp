#include "io/plot_trace.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/plot_scale.hpp"
#include "io/plot_text.hpp"
#include "io/spectrum.hpp"

namespace gearsweep {
namespace {

constexpr const char* kGrid = "set grid linetype 1 linewidth 0.6 linecolor rgb '#dddddd'\n";

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
        "{} using 1:2 with points pointtype 7 pointsize {} linecolor rgb '#000000' notitle, \\\n"
        "     ",
        data, few ? 1.9 : 1.1);
  }
  script->text += fmt::format(
      "{} using 1:2 with points pointtype 7 pointsize {} linecolor rgb '{}' title {}", data,
      few ? 1.3 : 0.5, layer_colour(layer), over_curves ? quote("") : key_title(picture, layer));
  for (std::size_t i = 0; i < section.x.size(); ++i) {
    append_numbers({section.x[i], section.y[i]}, &script->data);
  }
}

std::string phase_axes(const TracePicture& picture, const ValueRange& x, const ValueRange& y) {
  return fmt::format("set xlabel {}\nset xrange [{}:{}]\n",
                     quote(label_of(picture.across.name, picture.across.unit)), x.least,
                     x.greatest) +
         channel_axis(picture, y);
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

std::string trace_frame(const TracePicture& picture, const std::string& subtitle,
                        const std::vector<std::string>& key) {
  std::vector<std::string> entries;
  for (const TraceLayer& layer : picture.layers) entries.push_back(layer.name);
  if (entries.size() == 1) entries.clear();
  entries.insert(entries.end(), key.begin(), key.end());
  return set_title(title_lines(picture.title, subtitle, picture.remark, true)) +
         "set border linewidth 1\nset tics out nomirror\n" + key_below(entries);
}

std::string time_axis(const TracePicture& picture) {
  return fmt::format("set xlabel 'time [{} periods]'\nset xrange [0:{}]\n", picture.forcing,
                     last_period(picture));
}

std::string channel_axis(const TracePicture& picture, const ValueRange& range) {
  return fmt::format("set ylabel {}\nset yrange [{}:{}]\n",
                     quote(label_of(picture.channel.name, picture.channel.unit)), range.least,
                     range.greatest);
}

std::string key_title(const TracePicture& picture, std::size_t layer) {
  return quote(picture.layers.size() > 1 ? literal(picture.layers[layer].name) : "");
}

void add_histories(const TracePicture& picture, PlotScript* script) {
  for (std::size_t i = 0; i < picture.layers.size(); ++i) {
    const TraceLayer& layer = picture.layers[i];
    const std::vector<double> time = periods_of(layer.trace);
    const std::vector<double>& values = values_of(layer.trace, picture.channel.name);
    script->text += fmt::format("{}{} using 1:2 with lines linewidth 1.5 {} title {}",
                                i == 0 ? "" : ", \\\n     ", next_records(*script, time.size(), 2),
                                layer_line(i), key_title(picture, i));
    for (std::size_t moment = 0; moment < time.size(); ++moment) {
      append_numbers({time[moment], values[moment]}, &script->data);
    }
  }
}

PlotScript draw_time(const TracePicture& picture) {
  const ValueRange range = padded_range(all_values(picture, picture.channel.name));
  PlotScript script;
  script.for_column = true;
  script.text = trace_frame(picture, picture.channel.meaning, {}) + time_axis(picture) +
                channel_axis(picture, range) + kGrid + "plot ";
  add_histories(picture, &script);
  script.text += "\n";
  return script;
}

PlotScript draw_phase(const TracePicture& picture) {
  PlotScript script;
  script.for_column = true;
  script.text = trace_frame(picture, pair_text(picture), {"phase 0"}) +
                phase_axes(picture, padded_range(all_values(picture, picture.across.name)),
                           padded_range(all_values(picture, picture.channel.name))) +
                "plot ";
  constexpr double kManyTurns = 40.0;  // that would run together
  const double width = last_period(picture) > kManyTurns ? 0.5 : 1.0;
  for (std::size_t i = 0; i < picture.layers.size(); ++i) {
    const Trace& trace = picture.layers[i].trace;
    const std::vector<double>& x = values_of(trace, picture.across.name);
    const std::vector<double>& y = values_of(trace, picture.channel.name);
    script.text +=
        fmt::format("{} using 1:2 with lines linewidth {} {} title {}, \\\n     ",
                    next_records(script, x.size(), 2), width, layer_line(i), key_title(picture, i));
    for (std::size_t moment = 0; moment < x.size(); ++moment) {
      append_numbers({x[moment], y[moment]}, &script.data);
    }
  }
  for (std::size_t i = 0; i < picture.layers.size(); ++i) {
    add_section(picture, i, true, &script);
    script.text += ", \\\n     ";
  }
  script.text +=
      "keyentry with points pointtype 7 pointsize 1.9 linecolor rgb '#000000' "
      "title 'phase 0'\n";
  return script;
}

PlotScript draw_section(const TracePicture& picture) {
  std::vector<double> x, y;
  for (const TraceLayer& layer : picture.layers) {
    const Section section = section_of(picture, layer.trace);
    x.insert(x.end(), section.x.begin(), section.x.end());
    y.insert(y.end(), section.y.begin(), section.y.end());
  }
  PlotScript script;
  script.for_column = true;
  script.text = trace_frame(picture, pair_text(picture) + ", at phase 0 of each period", {}) +
                phase_axes(picture, section_range(x, all_values(picture, picture.across.name)),
                           section_range(y, all_values(picture, picture.channel.name))) +
                "plot ";
  for (std::size_t i = 0; i < picture.layers.size(); ++i) {
    if (i > 0) script.text += ", \\\n     ";
    add_section(picture, i, false, &script);
  }
  script.text += "\n";
  return script;
}

PlotScript draw_spectrum(const TracePicture& picture) {
  constexpr double kShown = 100.0, kAbove = 5.0;  // dB
  constexpr double kLeast = 1e-300;               // of an amplitude that has a logarithm
  PlotScript script;
  script.for_column = true;
  std::string curves;
  double greatest = kLeast;
  for (std::size_t i = 0; i < picture.layers.size(); ++i) {
    const Trace& trace = picture.layers[i].trace;
    const int channel = find_channel(trace, picture.channel.name);
    const Spectrum spectrum = amplitude_spectrum(trace, static_cast<std::size_t>(channel), 0);
    curves += fmt::format(
        "{}{} using 1:2 with lines linewidth 1.5 {} title {}", i == 0 ? "" : ", \\\n     ",
        next_records(script, spectrum.amplitude.size(), 2), layer_line(i), key_title(picture, i));
    for (std::size_t bin = 0; bin < spectrum.amplitude.size(); ++bin) {
      const double order = static_cast<double>(bin) * spectrum.order_step;
      const double amplitude = std::max(spectrum.amplitude[bin], kLeast);
      append_numbers({order, decibels(amplitude)}, &script.data);
      if (order <= picture.orders) greatest = std::max(greatest, amplitude);
    }
  }
  const std::string unit = picture.channel.unit == "1" ? "" : " " + picture.channel.unit;
  script.text =
      trace_frame(picture, "amplitudes: " + picture.channel.meaning + ", without its mean", {}) +
      fmt::format(
          "set xlabel 'order, frequency / {} frequency'\nset xrange [0:{}]\n"
          "set ylabel {}\nset yrange [{}:{}]\n{}plot {}\n",
          picture.forcing, picture.orders,
          quote(fmt::format("{} [dB re 1{}]", literal(picture.channel.name), typeset(unit))),
          decibels(greatest) + kAbove - kShown, decibels(greatest) + kAbove, kGrid, curves);
  return script;
}

}  // namespace gearsweep
