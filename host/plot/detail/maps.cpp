// Which maps of which files a picture is of.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include "model/error.hpp"
#include "model/names.hpp"
#include "plot/band.hpp"
#include "plot/detail/curves.hpp"
#include "plot/detail/names.hpp"
#include "plot/detail/panels.hpp"
#include "plot/detail/sources.hpp"
#include "plot/detail/text.hpp"
#include "result/result_file.hpp"
#include "result/si_units.hpp"
#include "study/initial_policy.hpp"

namespace gearsweep {
namespace {

constexpr std::string_view kPoincare = "poincare";

// Along one axis the samples, where the file has them: a bifurcation diagram. Otherwise the first
// map, else the status, which every file has.
std::string default_quantity(const ResultFile& file, bool one_axis) {
  if (one_axis && !file.poincare_states().empty()) return std::string(kPoincare);
  for (const std::string& name : file.quantities()) {
    if (name != "status" && name != kPoincare) return name;
  }
  return "status";
}

std::string chosen_quantity(const ResultFile& file, const std::string& asked, bool one_axis) {
  const std::string name = asked.empty() ? default_quantity(file, one_axis) : asked;
  if (!name.starts_with(kPoincare)) return name;
  const std::vector<std::string> states = file.poincare_states();
  if (states.empty()) return name;
  if (!one_axis) {
    throw InputError(
        fmt::format("'{}' has the axes '{}' and '{}', but a bifurcation diagram has "
                    "one; cut it at one value of either (--at {}={}), or use a "
                    "study with one axis",
                    file.path(), file.axes()[0].name, file.axes()[1].name, file.axes()[1].name,
                    file.axes()[1].values.front()));
  }
  return name == kPoincare ? fmt::format("{}:{}", kPoincare, states.front()) : name;
}

MissingPoints find_missing(const ResultMap& map, const ResultMap& status) {
  MissingPoints missing;
  const std::size_t width = map.values.size() / map.points();
  std::vector<std::size_t> reasons(status.flags.size(), 0);
  std::size_t lost = 0;  // exponents of what is lost where a motion sticks
  for (std::size_t point = 0; point < map.points(); ++point) {
    const auto first = map.values.begin() + static_cast<std::ptrdiff_t>(point * width);
    const auto last = first + static_cast<std::ptrdiff_t>(width);
    missing.mask.push_back(
        std::none_of(first, last, [](double value) { return std::isfinite(value); }));
    const double reason = status.values[point];
    if (!missing.mask.back() || !(reason >= 0.0)) continue;
    if (std::find(first, last, -std::numeric_limits<double>::infinity()) != last) {
      ++lost;
      continue;
    }
    if (reason < static_cast<double>(reasons.size())) ++reasons[static_cast<std::size_t>(reason)];
  }
  std::vector<std::string> notes;
  if (lost > 0)
    notes.push_back(fmt::format("minus infinity at {} of {} points", lost, map.points()));
  for (std::size_t i = 0; i < reasons.size(); ++i) {
    if (reasons[i] == 0) continue;
    const std::string name = status.flags[i] == "ok" ? "undefined" : status.flags[i];
    notes.push_back(fmt::format("{} at {} of {} points", name, reasons[i], map.points()));
  }
  missing.note = fmt::format("{}", fmt::join(notes, ", "));
  return missing;
}

// With what else the file knows of its points.
void tell_apart(const ResultFile& file, const std::optional<Cut>& cut, ResultMap* map) {
  const auto read = [&](const std::string& name) -> std::optional<ResultMap> {
    const std::vector<std::string>& names = file.quantities();
    if (std::find(names.begin(), names.end(), name) == names.end()) return std::nullopt;
    return file.read(name, cut);
  };
  std::optional<ResultMap> motion, contact;
  if (map->name == "period") motion = read("motion_class");
  if (map->name == "attractor") contact = read("contact_class");
  tell_classes_apart(motion ? &*motion : nullptr, contact ? &*contact : nullptr, map);
}

// Markup "b = 0.7 (b_n)".
std::string cut_remark(const ResultFile& file, const Cut& cut, bool is_si) {
  const ResultAxis& axis = file.axes()[cut.axis];
  double value = axis.values[cut.index];
  std::string unit = axis.unit;
  const SiUnit si = is_si ? shown_unit(unit, file.scales()) : SiUnit{};
  if (si.scale > 0.0) {
    value *= si.scale;
    unit = si.name;
  }
  const std::string symbol = symbol_of(axis.name);
  const std::string shown = unit.empty() || unit == "1" ? "" : fmt::format(" {}", typeset(unit));
  return fmt::format("at {} = {:.4g}{}", symbol.empty() ? literal(axis.name) : symbol, value,
                     shown);
}

// The band of a curve whose quantity has percentiles in the file.
std::optional<CurveBand> read_band(const ResultFile& file, const std::optional<Cut>& cut,
                                   const ResultMap& map, bool is_si) {
  if (!map.flags.empty() || map.part_count() > 1) return std::nullopt;
  const std::optional<BandMaps> maps = band_maps(map.name, file.quantities());
  if (!maps) return std::nullopt;
  const auto read = [&](const std::string& name) {
    ResultMap one = file.read(name, cut);
    if (is_si) convert_to_si(file.scales(), &one);
    return one;
  };
  CurveBand band = {read(maps->low), read(maps->high), std::nullopt, maps->meaning};
  if (!maps->median.empty()) band.median = read(maps->median);
  return band;
}

// `request` names the cut.
Picture read_picture(const std::string& path, const std::string& quantity,
                     const PlotRequest& request) {
  const ResultFile file(path);
  std::optional<Cut> cut;
  if (request.at) {
    if (file.axes().size() < 2) {
      throw InputError(fmt::format("'{}' has one axis, '{}', so there is nothing to cut at {} = {}",
                                   file.path(), file.axes()[0].name, request.at->first,
                                   request.at->second));
    }
    cut = file.find_cut(request.at->first, request.at->second);
  }
  const bool one_axis = cut || file.axes().size() == 1;
  const bool is_layer = request.paths.size() > 1;
  Picture picture;
  picture.map = file.read(chosen_quantity(file, quantity, one_axis), cut);
  if ((!one_axis || is_layer) && picture.map.part_count() > 1) {
    const std::string first = picture.map.parts.front().name;
    picture.map = file.read(fmt::format("{}:{}", picture.map.name, first), cut);
  }
  picture.missing = find_missing(picture.map, file.read("status", cut));
  picture.title = file.title();
  picture.settings = file.settings_text();
  tell_apart(file, cut, &picture.map);
  if (request.style.is_si) {
    ensure_scales(file.scales(), path);
    convert_to_si(file.scales(), &picture.map);
  }
  if (one_axis && !is_layer && request.style.has_band) {
    picture.band = read_band(file, cut, picture.map, request.style.is_si);
  }
  if (cut) picture.remark = cut_remark(file, *cut, request.style.is_si);
  return picture;
}

// Throws InputError unless all are over one axis, of one name.
void ensure_one_axis(const std::vector<Picture>& layers, const PlotRequest& request) {
  const ResultAxis& first = layers.front().map.axes.front();
  for (std::size_t i = 0; i < layers.size(); ++i) {
    const std::vector<ResultAxis>& axes = layers[i].map.axes;
    if (axes.size() > 1) {
      throw InputError(fmt::format(
          "'{}' has the axes '{}' and '{}', but only what is over one axis can be "
          "stacked or laid over one another; cut it at one value of either (--at {}={})",
          request.paths[i], axes[0].name, axes[1].name, axes[1].name, axes[1].values.front()));
    }
    if (axes.front().name != first.name || axes.front().logarithmic != first.logarithmic) {
      throw InputError(fmt::format(
          "'{}' is over the {}axis '{}' and '{}' over the {}axis '{}', so they cannot be laid "
          "over one another",
          request.paths[0], first.logarithmic ? "logarithmic " : "", first.name, request.paths[i],
          axes.front().logarithmic ? "logarithmic " : "", axes.front().name));
    }
  }
}

std::vector<std::string> settings_of(const std::vector<Picture>& layers) {
  std::vector<std::string> settings;
  for (const Picture& layer : layers) settings.push_back(layer.settings);
  return settings;
}

// Markup: what was asked for, or the studies by what differs between them, or by their titles, or
// where these do not tell them apart by their files.
std::vector<std::string> names_of(const std::vector<Picture>& layers, const PlotRequest& request) {
  if (!request.style.legend.empty()) return given_legend(request.style, layers.size());
  const auto each = [](const std::vector<std::string>& texts,
                       std::string (*markup)(std::string_view)) {
    std::vector<std::string> out;
    for (const std::string& text : texts) out.push_back(markup(text));
    return out;
  };
  std::vector<std::string> titles, stems;
  for (const Picture& layer : layers) titles.push_back(layer.title);
  for (const std::string& path : request.paths) {
    stems.push_back(std::filesystem::path(path).stem().string());
  }
  std::vector<std::string> settings;
  for (const std::string& text :
       differing_settings(settings_of(layers), layers.front().map.axes.front().name))
    settings.push_back(settings_label(text));
  return first_distinct(
      {each(titles, literal), settings, each(stems, literal), each(request.paths, literal)});
}

// The layer that goes upwards, of two studies of which one goes upwards along the axis that they
// are plotted over, and the other downwards.
std::optional<std::size_t> upwards_of(const PlotRequest& request, const std::string& axis) {
  if (request.paths.size() != 2) return std::nullopt;
  std::vector<int> neighbours;
  for (const std::string& path : request.paths) {
    const ResultFile file(path);
    const std::string study = file.study_text();
    std::string along = setting_in(study, "initial", "along");
    if (along.empty()) along = file.axes().front().name;
    const std::string policy = setting_in(study, "initial", "policy");
    const auto info = std::ranges::find(initial_policies(), policy, &InitialPolicyInfo::name);
    const bool is_along = info != initial_policies().end() && along == axis;
    neighbours.push_back(is_along ? info->neighbour : 0);
  }
  if (neighbours[0] * neighbours[1] >= 0) return std::nullopt;
  return neighbours[0] < 0 ? 0 : 1;
}

void ensure_band(const std::vector<std::vector<Picture>>& panels, const PlotStyle& style) {
  const bool has_one = std::ranges::any_of(
      panels, [](const auto& layers) { return layers.front().band.has_value(); });
  if (!has_one) style.refuse_band();
}

// What the two are called: of a speed as engineers do.
std::vector<std::string> names_of_directions(std::size_t upwards, const ResultAxis& axis) {
  const bool is_speed = axis.unit == "varpi" || axis.unit == "rpm";
  const std::string up = is_speed ? "run-up" : "upwards",
                    down = is_speed ? "run-down" : "downwards";
  return upwards == 0 ? std::vector{up, down} : std::vector{down, up};
}

}  // namespace

PlotScript plot_maps(const Page& page, const PlotRequest& request) {
  if (request.periods || request.orders) {
    throw InputError("--periods and --orders are for traces, and these files hold maps");
  }
  const std::vector<std::string> quantities = split(request.quantity, ',');
  const bool is_one = quantities.size() == 1 && request.paths.size() == 1;
  if (request.paths.size() == 1 && !request.style.legend.empty()) {
    throw InputError("--legend names files that are laid over one another, and there is one");
  }
  if (is_one) {
    Picture picture = read_picture(request.paths.front(), request.quantity, request);
    if (!request.curves_path.empty()) {
      add_curves(request.curves_path, request.paths.front(), &picture);
    }
    if (picture.map.axes.size() == 2) {
      request.style.refuse_band();
      return plot_heat_map(page, picture);
    }
    const Stack stack = {{{std::move(picture)}}, {""}};
    ensure_band(stack.panels, request.style);
    return plot_stack(page, stack);
  }
  if (!request.curves_path.empty()) throw InputError("--curves is for one map of two axes");
  ensure_tellable(request.paths.size());
  constexpr std::size_t kMaxPanels = 8;
  if (quantities.size() > kMaxPanels) {
    throw InputError(fmt::format("{} quantities are too many for one picture; it holds {}",
                                 quantities.size(), kMaxPanels));
  }
  Stack stack;
  for (const std::string& quantity : quantities) {
    std::vector<Picture> layers;
    for (const std::string& path : request.paths) {
      layers.push_back(read_picture(path, quantity, request));
    }
    ensure_one_axis(layers, request);
    stack.panels.push_back(std::move(layers));
  }
  ensure_band(stack.panels, request.style);
  const ResultAxis& axis = stack.panels.front().front().map.axes.front();
  stack.upwards = upwards_of(request, axis.name);
  stack.names = stack.upwards && request.style.legend.empty()
                    ? names_of_directions(*stack.upwards, axis)
                    : names_of(stack.panels.front(), request);
  return plot_stack(page, stack);
}

}  // namespace gearsweep
