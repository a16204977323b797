#include "plot/detail/trace.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "plot/detail/density.hpp"
#include "plot/detail/scale.hpp"
#include "plot/detail/text.hpp"

namespace gearsweep {
namespace {

// The values at phase 0, over those of `across`.
struct Section {
  std::vector<double> x, y;
};

// Far less than a step, far more than the rounding of tau.
constexpr double kInstant = 1e-6;  // of a period

Section section_of(const TracePicture& picture, const Trace& trace) {
  const std::vector<double> time = times_of(trace);
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

// The dots of a layer, which stand out by a dark rim where they are few or lie over curves; as
// elements of "plot".
std::string add_section(const TracePicture& picture, std::size_t layer, bool over_curves,
                        PlotScript* script) {
  constexpr std::size_t kFew = 100;
  const Section section = section_of(picture, picture.layers[layer].trace);
  const bool few = section.x.size() <= kFew;
  const std::string data = next_records(*script, section.x.size(), 2);
  std::string elements;
  if (few || over_curves) {
    elements += fmt::format(
        "{} using 1:2 with points pointtype 7 pointsize dot*{} linecolor rgb '#000000' notitle, "
        "\\\n"
        "     ",
        data, few ? 1.5 : 0.9);
  }
  elements += fmt::format(
      "{} using 1:2 with points pointtype 7 pointsize dot*{} linecolor rgb '{}' notitle", data,
      few ? 1.1 : 0.4, layer_colour(layer));
  for (std::size_t i = 0; i < section.x.size(); ++i) {
    append_numbers({section.x[i], section.y[i]}, &script->data);
  }
  return elements;
}

// All layers' dots.
std::string add_sections(const TracePicture& picture, bool over_curves, PlotScript* script) {
  std::string elements;
  for (std::size_t i = 0; i < picture.layers.size(); ++i) {
    if (i > 0) elements += ", \\\n     ";
    elements += add_section(picture, i, over_curves, script);
  }
  return elements;
}

// y over x as data of "plot". No line joins what stands at one moment, before and behind a jump,
// nor two moments between which the state was reset.
std::string add_curve(const Trace& trace, const std::vector<double>& x,
                      const std::vector<double>& y, PlotScript* script) {
  const int events = find_channel(trace, kEvents);
  const auto jumps_before = [&](std::size_t i) {
    if (i == 0) return false;
    if (trace.tau[i] == trace.tau[i - 1]) return x[i] != x[i - 1] || y[i] != y[i - 1];
    const bool is_exact = i + 1 < x.size() && trace.tau[i + 1] == trace.tau[i];
    return events >= 0 && !is_exact && trace.values[static_cast<std::size_t>(events)][i] > 0.0;
  };
  std::size_t breaks = 0;
  for (std::size_t i = 0; i < x.size(); ++i) breaks += jumps_before(i) ? 1 : 0;
  const std::string data = next_records(*script, x.size() + breaks, 2) + " using 1:2";
  constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (jumps_before(i)) append_numbers({kNothing, kNothing}, &script->data);
    append_numbers({x[i], y[i]}, &script->data);
  }
  return data;
}

double last_time(const TracePicture& picture) {
  double last = 0.0;
  for (const TraceLayer& layer : picture.layers) {
    const std::vector<double> times = shown_times(picture, layer.trace);
    if (!times.empty()) last = std::max(last, times.back());
  }
  if (picture.is_clockless || picture.milliseconds > 0.0) return last;
  // The even moments of a period end before the next begins.
  constexpr double kNearly = 0.1;
  return std::ceil(last) - last < kNearly ? std::ceil(last) : last;
}

PanelAxis across_axis(const Page& page, const TracePicture& picture, const ValueRange& range) {
  return {axis_text(page.style().xlabel, channel_label(picture.across)),
          shown_range(range, page.style().xrange, "--xrange")};
}

// The range of a section, but not so narrow that an orbit's rounding would fill it.
ValueRange section_range(const std::vector<double>& section, const std::vector<double>& trace) {
  constexpr double kNarrowest = 0.02;  // of the whole motion
  ValueRange range = padded_range(section);
  const ValueRange whole = padded_range(trace);
  const double min = kNarrowest * (whole.max - whole.min);
  const double more = 0.5 * std::max(0.0, min - (range.max - range.min));
  return {range.min - more, range.max + more};
}

// Velocities are called after their positions, so these say it all.
std::string pair_text(const TracePicture& picture) {
  if (picture.channel.meaning.find(picture.across.name) != std::string::npos) {
    return picture.across.meaning;
  }
  return fmt::format("{}; {}", picture.across.meaning, picture.channel.meaning);
}

}  // namespace

std::vector<std::string> axis_text(const std::optional<std::string>& given,
                                   const std::string& own) {
  return {given ? literal(*given) : own};
}

AxisRange shown_range(const ValueRange& range, const Limits& limits, const std::string& option) {
  const ValueRange own = limited(range, limits, option);
  return {own.min, own.max, false};
}

int find_channel(const Trace& trace, const std::string& name) {
  const auto found = std::find_if(trace.channels.begin(), trace.channels.end(),
                                  [&](const ChannelInfo& channel) { return channel.name == name; });
  return found == trace.channels.end() ? -1 : static_cast<int>(found - trace.channels.begin());
}

const ChannelInfo* force_of(const Trace& trace) {
  const auto found = std::ranges::find(trace.channels, Role::mesh_force, &ChannelInfo::role);
  return found == trace.channels.end() ? nullptr : &*found;
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

std::vector<double> times_of(const Trace& trace) {
  const double unit = trace.is_clockless ? 1.0 : trace.period;
  std::vector<double> times;
  for (const double tau : trace.tau) times.push_back(tau / unit);
  return times;
}

std::vector<double> shown_times(const TracePicture& picture, const Trace& trace) {
  if (picture.milliseconds <= 0.0) return times_of(trace);
  std::vector<double> times;
  for (const double tau : trace.tau) times.push_back(tau * picture.milliseconds);
  return times;
}

double whole_periods(const Trace& trace) {
  if (trace.tau.empty()) return 0.0;
  return std::ceil(trace.tau.back() / trace.period - kInstant);
}

Trace last_periods(const Trace& trace, std::size_t periods) {
  const double from = whole_periods(trace) - static_cast<double>(periods);
  if (from <= 0.0) return trace;
  const auto first =
      std::lower_bound(trace.tau.begin(), trace.tau.end(), (from - kInstant) * trace.period) -
      trace.tau.begin();
  Trace last = trace;
  last.tau.erase(last.tau.begin(), last.tau.begin() + first);
  for (double& tau : last.tau) tau -= from * trace.period;
  for (std::vector<double>& values : last.values) {
    values.erase(values.begin(), values.begin() + first);
  }
  return last;
}

PanelAxis time_axis(const Page& page, const TracePicture& picture) {
  const std::string unit = picture.milliseconds > 0.0 ? " (ms)"
                           : picture.is_clockless     ? ""
                                                  : fmt::format(" ({} periods)", picture.period);
  return {axis_text(page.style().xlabel, "time" + unit),
          shown_range({0.0, last_time(picture)}, page.style().xrange, "--xrange")};
}

PanelAxis channel_axis(const Page& page, const TracePicture& picture, const ValueRange& range) {
  return {axis_text(page.style().ylabel, channel_label(picture.channel)),
          shown_range(range, page.style().yrange, "--yrange")};
}

std::string add_histories(const TracePicture& picture, PlotScript* script) {
  std::string elements;
  for (std::size_t i = 0; i < picture.layers.size(); ++i) {
    const Trace& trace = picture.layers[i].trace;
    elements += fmt::format("{}{} with lines linewidth 2 {} notitle", i == 0 ? "" : ", \\\n     ",
                            add_curve(trace, shown_times(picture, trace),
                                      values_of(trace, picture.channel.name), script),
                            layer_line(i));
  }
  return elements;
}

void add_events(const TracePicture& picture, TracePanel* panel, PlotScript* script) {
  bool has_some = false;
  for (std::size_t i = 0; i < picture.layers.size(); ++i) {
    const Trace& trace = picture.layers[i].trace;
    if (find_channel(trace, kEvents) < 0) continue;
    const std::vector<double>& events = values_of(trace, kEvents);
    const std::vector<double>& values = values_of(trace, picture.channel.name);
    std::vector<std::size_t> marked;
    for (std::size_t moment = 0; moment < events.size(); ++moment) {
      if (events[moment] != 0.0) marked.push_back(moment);
    }
    if (marked.empty()) continue;
    has_some = true;
    panel->elements += fmt::format(
        ", \\\n     {} using 1:2 with points pointtype 6 pointsize dot linecolor rgb '{}' notitle",
        next_records(*script, marked.size(), 2), layer_colour(i));
    const std::vector<double> time = shown_times(picture, trace);
    for (const std::size_t moment : marked) {
      append_numbers({time[moment], values[moment]}, &script->data);
    }
  }
  if (has_some) panel->key.push_back({KeyEntry::Kind::kCircle, "#000000", "1", "at a surface"});
}

TracePanel time_panel(const Page& page, const TracePicture& picture, PlotScript* script) {
  const ValueRange range = padded_range(all_values(picture, picture.channel.name));
  TracePanel panel;
  panel.kind = "time history";
  panel.subtitle = picture.channel.meaning;
  panel.x = time_axis(page, picture);
  panel.y = channel_axis(page, picture, range);
  panel.lines = grid_lines();
  panel.elements = add_histories(picture, script);
  add_events(picture, &panel, script);
  return panel;
}

TracePanel phase_panel(const Page& page, const TracePicture& picture, PlotScript* script) {
  constexpr double kManyTurns = 40.0;      // that would run together
  constexpr double kTooManyTurns = 200.0;  // that would be one dark patch
  const bool has_many = std::ranges::any_of(picture.layers, [](const TraceLayer& layer) {
    return whole_periods(layer.trace) > kManyTurns;
  });
  const double width = has_many ? 0.7 : 1.6;
  TracePanel panel;
  panel.kind = "phase portrait";
  panel.subtitle = pair_text(picture);
  panel.x = across_axis(page, picture, padded_range(all_values(picture, picture.across.name)));
  panel.y = channel_axis(page, picture, padded_range(all_values(picture, picture.channel.name)));
  const Trace& first = picture.layers.front().trace;
  if (picture.layers.size() == 1 && whole_periods(first) > kTooManyTurns) {
    panel.lines = density_lines();
    panel.elements =
        add_density(values_of(first, picture.across.name), values_of(first, picture.channel.name),
                    panel.x.range, panel.y.range, script);
    panel.key = {{KeyEntry::Kind::kBox, kDensestColour, "1", "darker: more often there"}};
    return panel;
  }
  for (std::size_t i = 0; i < picture.layers.size(); ++i) {
    const Trace& trace = picture.layers[i].trace;
    const std::vector<double>& x = values_of(trace, picture.across.name);
    const std::vector<double>& y = values_of(trace, picture.channel.name);
    panel.elements +=
        fmt::format("{}{} with lines linewidth {} {} notitle", i == 0 ? "" : ", \\\n     ",
                    add_curve(trace, x, y, script), width, layer_line(i));
  }
  if (!picture.is_clockless) {
    panel.elements += ", \\\n     " + add_sections(picture, true, script);
    panel.key = {{KeyEntry::Kind::kDot, "#000000", "1", "phase 0"}};
  }
  return panel;
}

TracePanel section_panel(const Page& page, const TracePicture& picture, PlotScript* script) {
  std::vector<double> x, y;
  for (const TraceLayer& layer : picture.layers) {
    const Section section = section_of(picture, layer.trace);
    x.insert(x.end(), section.x.begin(), section.x.end());
    y.insert(y.end(), section.y.begin(), section.y.end());
  }
  TracePanel panel;
  panel.kind = "section at phase 0";
  panel.subtitle = pair_text(picture) + ", at phase 0 of each period";
  panel.x = across_axis(page, picture, section_range(x, all_values(picture, picture.across.name)));
  panel.y =
      channel_axis(page, picture, section_range(y, all_values(picture, picture.channel.name)));
  panel.elements = add_sections(picture, false, script);
  panel.layer_kind = KeyEntry::Kind::kDot;
  return panel;
}

}  // namespace gearsweep
