// Which traces of which files a picture is of, and what of them.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>

#include "model/error.hpp"
#include "model/names.hpp"
#include "plot/detail/names.hpp"
#include "plot/detail/sources.hpp"
#include "plot/detail/text.hpp"
#include "plot/detail/trace.hpp"
#include "result/si_units.hpp"
#include "result/trace_file.hpp"

namespace gearsweep {
namespace {

using PanelMaker = TracePanel (*)(const Page&, const TracePicture&, PlotScript*);

struct Kind {
  std::string name;
  PanelMaker panel;  // null of a portrait, which has several
  bool is_recent;    // shows the last periods only, unless more are asked for
  std::size_t channels;
};

constexpr std::string_view kPortrait = "portrait";

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> kKinds = {
      {"time", time_panel, true, 1},        {"phase", phase_panel, false, 2},
      {"section", section_panel, false, 2}, {"spectrum", spectrum_panel, false, 1},
      {"force", force_panel, true, 1},      {std::string(kPortrait), nullptr, false, 2}};
  return kKinds;
}

// `words`: of the quantity, at its colons.
const Kind& find_kind(const std::vector<std::string>& words) {
  const std::string name = words.front().empty() ? "time" : words.front();
  std::vector<std::string> names;
  for (const Kind& kind : kinds()) {
    names.push_back(kind.name);
    if (kind.name != name) continue;
    if (words.size() - 1 > kind.channels) {
      throw InputError(fmt::format("'{}' is of {}", name,
                                   kind.channels == 1 ? "one channel, as in " + name + ":x1"
                                                      : "two channels, as in " + name + ":x1:v1"));
    }
    return kind;
  }
  throw InputError(
      fmt::format("unknown picture of a trace '{}'{}", name, suggest_name(name, names)));
}

ChannelInfo find_in(const StoredTrace& stored, const std::string& name) {
  std::vector<std::string> names;
  for (const ChannelInfo& channel : stored.trace.channels) {
    if (channel.name == name) return channel;
    names.push_back(channel.name);
  }
  throw InputError(fmt::format("the trace has no channel '{}'{}", name, suggest_name(name, names)));
}

bool has_velocity(const ChannelInfo& channel) { return !channel.velocity.empty(); }

// The state that is the rate of this one; empty where none is. Files of before do not say it, and
// their models call them "x3" and "v3".
std::string velocity_of(const Trace& trace, const std::string& position) {
  if (std::ranges::any_of(trace.channels, has_velocity)) {
    const int channel = find_channel(trace, position);
    if (channel < 0) return "";
    const std::string& velocity = trace.channels[static_cast<std::size_t>(channel)].velocity;
    return find_channel(trace, velocity) < 0 ? "" : velocity;
  }
  if (!position.starts_with('x')) return "";
  const std::string velocity = fmt::format("v{}", position.substr(1));
  return find_channel(trace, velocity) < 0 ? "" : velocity;
}

// What is plotted of a trace where nobody says it: of two channels the first state that has a rate.
std::string usual_channel(const Trace& trace, std::size_t channels) {
  const auto moving = std::ranges::find_if(trace.channels, has_velocity);
  if (channels == 1 || moving == trace.channels.end()) return trace.channels.front().name;
  return moving->name;
}

void refuse_without_flanks(const Trace& trace) {
  if (find_channel(trace, "contact") >= 0) return;
  const auto is_flank = [](const ChannelInfo& channel) {
    return channel.name.ends_with("_contact");
  };
  const auto several = std::ranges::find_if(trace.channels, is_flank);
  if (several == trace.channels.end()) {
    throw InputError(
        "'force' shows the flanks in contact, and this model has neither backlash nor stop");
  }
  throw InputError(
      fmt::format("'force' shows the flanks of a model's only contact, and this model "
                  "has several; -q time:{} draws one of them",
                  several->name));
}

// What is plotted: one channel, or of a phase portrait that over which it is plotted, then it.
std::vector<std::string> channel_names(const Kind& kind, const std::vector<std::string>& words,
                                       const Trace& trace) {
  std::vector<std::string> names(words.begin() + 1, words.end());
  if (kind.name == "force") {
    refuse_without_flanks(trace);
    const ChannelInfo* force = force_of(trace);
    if (names.empty() && force == nullptr) {
      throw InputError(
          "the file does not say which signal is the force between the teeth; name a channel: -q "
          "force:NAME, or give that signal role = \"mesh_force\" in the model's file, and trace "
          "again");
    }
    if (names.empty()) return {force->name};
  }
  const bool is_chosen = !names.empty();
  if (!is_chosen) names.push_back(usual_channel(trace, kind.channels));
  if (kind.channels == 1 || names.size() == 2) return names;
  std::string velocity = velocity_of(trace, names.front());
  if (velocity.empty() && !is_chosen && trace.channels.size() > 1) {
    velocity = trace.channels[1].name;
  }
  if (velocity.empty()) {
    find_in({"", "", "", {}, {}, trace}, names.front());
    throw InputError(
        fmt::format("'{0}' has no velocity beside it; name two channels, as in {1}:{0}:{2}",
                    names.front(), kind.name, trace.channels.front().name));
  }
  return {names.front(), velocity};
}

struct Source {
  std::string path;
  StoredTrace stored;
};

std::vector<Source> read_sources(const std::vector<std::string>& paths, bool is_si) {
  std::vector<Source> sources;
  for (const std::string& path : paths) {
    for (StoredTrace& stored : read_traces(path)) {
      if (is_si) {
        ensure_scales(stored.scales, path);
        convert_to_si(stored.scales, &stored.trace);
      }
      sources.push_back({path, std::move(stored)});
    }
  }
  ensure_tellable(sources.size());
  return sources;
}

// What all traces say; empty where they differ.
std::string common(const std::vector<Source>& sources,
                   const std::function<std::string(const Source&)>& text) {
  const std::string first = text(sources.front());
  const bool same = std::all_of(sources.begin(), sources.end(),
                                [&](const Source& source) { return text(source) == first; });
  return same ? first : "";
}

// Markup: what was asked for, or the traces by their labels, by what differs between their studies,
// or where these do not tell them apart by their files.
std::vector<std::string> names_of(const std::vector<Source>& sources, const PlotStyle& style) {
  if (!style.legend.empty()) return given_legend(style, sources.size());
  std::vector<std::string> labels, titles, settings, differences, stems, both;
  for (const Source& source : sources) {
    labels.push_back(settings_label(source.stored.label));
    titles.push_back(literal(source.stored.title));
    settings.push_back(source.stored.settings);
    stems.push_back(literal(std::filesystem::path(source.path).stem().string()));
    both.push_back(fmt::format("{}: {}", literal(source.path), labels.back()));
  }
  for (const std::string& text : differing_settings(settings, "")) {
    differences.push_back(settings_label(text));
  }
  return first_distinct({labels, titles, differences, stems, both});
}

// Markup.
std::string remark_of(const std::vector<Source>& sources, std::optional<std::size_t> shown) {
  const std::string label =
      common(sources, [](const Source& source) { return source.stored.label; });
  std::string remark = label.empty() ? "" : "at " + settings_label(label);
  const auto is_longer = [&](const Source& source) {
    return shown && whole_periods(source.stored.trace) > static_cast<double>(*shown);
  };
  if (std::any_of(sources.begin(), sources.end(), is_longer)) {
    remark += fmt::format("{}the last {} periods", remark.empty() ? "" : "; ", *shown);
  }
  return remark;
}

}  // namespace

double usual_width(const PlotRequest& request) {
  constexpr double kTwoColumns = 170.0;
  return split(request.quantity, ':').front() == kPortrait ? kTwoColumns : kUsualWidth;
}

PlotScript plot_traces(const Page& page, const PlotRequest& request) {
  if (request.at) {
    throw InputError("--at cuts maps, and this file holds traces; 'gearsweep trace' takes --at");
  }
  const std::vector<std::string> words = split(request.quantity, ':');
  const Kind& kind = find_kind(words);
  if (request.orders && kind.name != "spectrum" && kind.name != kPortrait) {
    throw InputError("--orders is for spectra (-q spectrum or portrait)");
  }
  const std::vector<Source> sources = read_sources(request.paths, request.style.is_si);
  const Trace& first = sources.front().stored.trace;
  const std::vector<std::string> channels = channel_names(kind, words, first);
  TracePicture picture;
  picture.recent = request.periods.value_or(picture.recent);
  std::optional<std::size_t> shown = request.periods;
  if (kind.is_recent) shown = picture.recent;
  if (kind.name == kPortrait) shown.reset();  // all of it, but for the histories
  picture.across = find_in(sources.front().stored, channels.front());
  picture.channel = find_in(sources.front().stored, channels.back());
  picture.title = common(sources, [](const Source& source) { return source.stored.title; });
  picture.remark = remark_of(sources, shown);
  picture.forcing = force_of(first) == nullptr ? "forcing" : "mesh";
  picture.meshes = sources.front().stored.meshes;
  picture.period = first.mesh_periods == 1.0 ? picture.forcing : "forcing";
  picture.is_clockless = first.is_clockless;
  if (picture.is_clockless && kind.panel == section_panel) {
    throw InputError(
        "'section' is at phase 0 of the forcing, and this model has none; a map has samples at a "
        "section of the model: quantities = [\"poincare\"]");
  }
  if (request.style.is_si) {
    picture.milliseconds = 1e3 / sources.front().stored.scales.varpi;
  }
  picture.orders = request.orders.value_or(picture.orders);
  const std::vector<std::string> names = names_of(sources, request.style);
  for (std::size_t i = 0; i < sources.size(); ++i) {
    const StoredTrace& stored = sources[i].stored;
    if (stored.trace.is_clockless != first.is_clockless) {
      throw InputError("one of these traces is of a model without forcing, and another is not");
    }
    for (const std::string& name : channels) find_in(stored, name);
    if (kind.name == "force") find_in(stored, "contact");
    picture.layers.push_back({names[i], shown ? last_periods(stored.trace, *shown) : stored.trace});
  }
  PlotScript script;
  const std::vector<TracePanel> panels = kind.panel == nullptr
                                             ? portrait_panels(page, picture, &script)
                                             : std::vector{kind.panel(page, picture, &script)};
  lay_out(page, picture, panels, &script);
  return script;
}

}  // namespace gearsweep
