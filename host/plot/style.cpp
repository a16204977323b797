#include "plot/style.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "model/error.hpp"
#include "model/names.hpp"
#include "model/parse_number.hpp"
#include "model/regular_file.hpp"
#include "plot/colours.hpp"
#include "study/nesting.hpp"

namespace gearsweep {
namespace {

std::optional<double> number_in(std::string_view text) {
  const std::optional<double> number = parse_number<double>(text);
  return number && std::isfinite(*number) ? number : std::nullopt;
}

// "85mm", "8.5cm", "3.3in" in mm, or "1400px" in pixels; a plain number has the fallback's unit.
struct Length {
  double value = 0.0;
  std::string unit;
};

// "mm" of "85mm"; may be empty.
std::string unit_in(const std::string& text) {
  std::size_t end = text.size();
  while (end > 0 && std::isalpha(static_cast<unsigned char>(text[end - 1])) != 0) --end;
  return text.substr(end);
}

std::optional<Length> length_in(const std::string& text, const std::string& fallback) {
  std::string unit = unit_in(text);
  const std::optional<double> value = number_in(text.substr(0, text.size() - unit.size()));
  if (unit.empty()) unit = fallback;
  if (!value || *value <= 0.0) return std::nullopt;
  if (unit == "cm") return Length{10.0 * *value, "mm"};
  if (unit == "in") return Length{kMmPerInch * *value, "mm"};
  if (unit == "mm" || unit == "px") return Length{*value, unit};
  return std::nullopt;
}

void ensure_sensible(const Length& length, const std::string& text) {
  const double min = length.unit == "mm" ? 20.0 : 100.0;
  const double max = length.unit == "mm" ? 1000.0 : 10000.0;
  if (length.value >= min && length.value <= max) return;
  throw InputError(fmt::format("'{}' is not between {} and {} {}", text, min, max, length.unit));
}

void set_size(const std::string& text, PlotStyle* style) {
  // The last one but for that of "px".
  const std::size_t cross = text.find_last_of('x', text.size() - unit_in(text).size());
  std::optional<Length> width, height;
  if (cross != std::string::npos) {
    const std::string high = text.substr(cross + 1), unit = unit_in(high);
    height = length_in(high, "px");
    width = length_in(text.substr(0, cross), unit.empty() ? "px" : unit);
  }
  if (!width || !height || width->unit != height->unit) {
    throw InputError(fmt::format(
        "'{}' is no size; give width x height in mm, cm, in or px, as in 85x64mm", text));
  }
  ensure_sensible(*width, text);
  ensure_sensible(*height, text);
  style->size = {width->value, height->value, width->unit == "px"};
}

void set_width(const std::string& text, PlotStyle* style) {
  const std::optional<Length> width = length_in(text, "mm");
  if (!width) {
    throw InputError(
        fmt::format("'{}' is no width; give it in mm, cm, in or px, as in 85mm", text));
  }
  ensure_sensible(*width, text);
  style->size = {width->value, 0.0, width->unit == "px"};
}

// A font's name goes into a script, so it is made of harmless letters.
void set_font(const std::string& text, PlotStyle* style) {
  const std::size_t comma = text.find(',');
  const std::string name = text.substr(0, comma);
  const bool is_plain = std::all_of(name.begin(), name.end(), [](char letter) {
    return std::isalnum(static_cast<unsigned char>(letter)) != 0 || letter == ' ' ||
           letter == '-' || letter == '_' || letter == '.';
  });
  constexpr double kMin = 3.0, kMax = 72.0;
  std::optional<double> size;
  if (comma != std::string::npos) size = number_in(text.substr(comma + 1));
  const bool is_sized = comma == std::string::npos || (size && *size >= kMin && *size <= kMax);
  if (!is_plain || !is_sized || text.empty()) {
    throw InputError(fmt::format(
        "'{}' is no font; give its name and its size in points ({} to {}), as in 'Times New "
        "Roman,8' (letters, digits, blanks and - _ . make a name)",
        text, kMin, kMax));
  }
  if (!name.empty()) style->font = name;
  if (size) style->font_size = *size;
}

Limits limits_in(const std::string& text) {
  const std::size_t colon = text.find(':');
  const auto refuse = [&] {
    throw InputError(fmt::format(
        "'{}' is no range; give MIN:MAX, as in 0.4:2, or leave one end out, as in 0:", text));
  };
  if (colon == std::string::npos || text == ":") refuse();
  Limits limits;
  if (colon > 0) limits.min = number_in(std::string_view(text).substr(0, colon));
  if (colon + 1 < text.size()) limits.max = number_in(std::string_view(text).substr(colon + 1));
  if ((colon > 0 && !limits.min) || (colon + 1 < text.size() && !limits.max)) refuse();
  if (limits.min && limits.max && *limits.min >= *limits.max) {
    throw InputError(fmt::format("'{}' is no range: its first number must be the smaller", text));
  }
  return limits;
}

void set_colormap(const std::string& text, PlotStyle* style) {
  ensure_colormap(text);
  style->colormap = text;
}

void set_contours(const std::vector<std::string>& texts, PlotStyle* style) {
  constexpr std::size_t kMost = 50;
  const auto refuse = [&] {
    throw InputError(fmt::format(
        "'{}' are no contours; give how many (at most {}), as in 6, or their levels, as in "
        "0.5,1,1.5 (a whole number as the only level: 2,)",
        fmt::join(texts, ","), kMost));
  };
  Contours contours;
  for (const std::string& text : texts) {
    if (text.empty() && texts.size() > 1) continue;  // "2," is one level
    const std::optional<double> value = number_in(text);
    if (!value) refuse();
    contours.levels.push_back(*value);
  }
  if (contours.levels.empty() || contours.levels.size() > kMost) refuse();
  const double only = contours.levels.front();
  const bool is_count = texts.size() == 1 && only >= 1.0 && only <= static_cast<double>(kMost) &&
                        only == std::round(only);
  if (is_count) {
    contours.count = static_cast<std::size_t>(only);
    contours.levels.clear();
  }
  style->contours = contours;
}

bool flag_in(const std::string& text) {
  if (text != "true" && text != "false") throw InputError("it must be true or false");
  return text == "true";
}

bool is_yes(const std::string& text) {
  if (text != "yes" && text != "no") {
    throw InputError(fmt::format("'{}' is no answer; give yes or no", text));
  }
  return text == "yes";
}

bool is_si(const std::string& text) {
  if (text != "SI" && text != "model") {
    throw InputError(fmt::format("'{}' are no units; give SI or model", text));
  }
  return text == "SI";
}

// "viridis|plasma|..."
std::string colormap_choices() {
  std::vector<std::string> names = colormap_names();
  std::erase_if(names, [](const std::string& name) { return name.ends_with("_r"); });
  return fmt::format("{}", fmt::join(names, "|"));
}

StyleOption one(const std::string& name, const std::string& value, const std::string& meaning,
                void (*set)(const std::string&, PlotStyle*)) {
  return {name, value, meaning, false,
          [set](const std::vector<std::string>& texts, PlotStyle* style) {
            set(texts.front(), style);
          }};
}

// The values of a key as texts; one of what is no list.
std::vector<std::string> texts_of(const toml::node& node, const StyleOption& option,
                                  const std::string& place) {
  const auto refuse = [&] {
    const std::string right = option.value.empty() ? "true or false"
                              : option.is_list
                                  ? "a list, as in [\"a\", \"b\"] or [1, 2]"
                                  : "a text or a number, as in \"" + option.value + "\"";
    throw InputError(fmt::format("{}: {} must be {}", place, option.name, right));
  };
  std::vector<std::string> texts;
  const auto add = [&](const toml::node& element) {
    if (const auto text = element.value_exact<std::string>()) {
      texts.push_back(*text);
    } else if (const auto number = element.value<double>(); number && element.is_number()) {
      texts.push_back(fmt::format("{}", *number));
    } else {
      refuse();
    }
  };
  if (option.value.empty()) {
    const auto flag = node.value_exact<bool>();
    if (!flag) refuse();
    return {*flag ? "true" : "false"};
  }
  if (const toml::array* array = node.as_array(); array != nullptr && option.is_list) {
    for (const toml::node& element : *array) add(element);
    if (texts.empty()) refuse();
    if (texts.size() == 1 && option.may_count) texts.emplace_back();  // as "2,": a list of one
  } else {
    add(node);
  }
  return texts;
}

}  // namespace

void PlotStyle::refuse(const std::string& option, const std::string& why) const {
  if (demanded.contains(option)) throw InputError(fmt::format("--{}: {}", option, why));
}

void PlotStyle::refuse_band() const {
  if (!has_band) return;
  refuse("band",
         "nothing drawn here has a band; a curve of one file over one axis has it, where the "
         "study's [uncertain] gives two percentiles");
}

const std::vector<StyleOption>& style_options() {
  static const std::vector<StyleOption> kOptions = {
      one("size", "WxH", "Width and height: 85x64mm (also cm, in; px for .png and .svg)", set_size),
      one("width", "LENGTH", "The width alone, as in 85mm; the height suits the picture",
          set_width),
      one("font", "NAME,POINTS", "Font of all letters, as in 'Latin Modern Roman,8'", set_font),
      one("title", "TEXT", "Title in place of the study's; '' for none",
          [](const std::string& text, PlotStyle* style) { style->title = text; }),
      one("xlabel", "TEXT", "Label of the horizontal axis",
          [](const std::string& text, PlotStyle* style) { style->xlabel = text; }),
      one("ylabel", "TEXT", "Label of the vertical axis (of several panels: the first)",
          [](const std::string& text, PlotStyle* style) { style->ylabel = text; }),
      one("label", "TEXT", "Label of the colour bar",
          [](const std::string& text, PlotStyle* style) { style->label = text; }),
      {"legend", "A,B,...", "Names of the files or traces that are laid over one another", true,
       [](const std::vector<std::string>& texts, PlotStyle* style) { style->legend = texts; }},
      one("xrange", "LO:HI", "Range of the horizontal axis; either end may be left out",
          [](const std::string& text, PlotStyle* style) { style->xrange = limits_in(text); }),
      one("yrange", "LO:HI", "Range of the vertical axis (of several panels: the first)",
          [](const std::string& text, PlotStyle* style) { style->yrange = limits_in(text); }),
      one("range", "LO:HI", "Range of the colours, so that several pictures share a scale",
          [](const std::string& text, PlotStyle* style) { style->range = limits_in(text); }),
      one("colormap", colormap_choices(),
          "Colours by names as in matplotlib, which end in _r for the other way round: viridis_r",
          set_colormap),
      one("log", "", "Logarithmic colours, or a logarithmic vertical axis",
          [](const std::string& text, PlotStyle* style) { style->is_log = flag_in(text); }),
      {"contours", "LEVELS", "Contour lines in a map: how many, or their levels: 0.5,1,1.5", true,
       set_contours, true},
      one("band", "yes|no",
          "The band of tolerances around a curve whose study has [uncertain] (default: yes)",
          [](const std::string& text, PlotStyle* style) { style->has_band = is_yes(text); }),
      one("units", "SI|model",
          "SI: rpm, N, um, ms, which a study with a [gear] table has unless model is given",
          [](const std::string& text, PlotStyle* style) {
            style->is_si = is_si(text);
            style->has_units = true;
          })};
  return kOptions;
}

void read_style_file(const std::string& path, PlotStyle* style) {
  has_regular_file(path, "a style file");
  constexpr std::size_t kMaxBytes = 100'000;
  std::string content(kMaxBytes + 1, '\0');
  std::ifstream in(path, std::ios::binary);
  in.read(content.data(), static_cast<std::streamsize>(content.size()));
  if (!in.is_open() || in.bad()) {
    throw InputError(fmt::format("cannot read the style file '{}'", path));
  }
  content.resize(static_cast<std::size_t>(in.gcount()));
  if (content.size() > kMaxBytes) {
    throw InputError(fmt::format("'{}' is too large for a style file", path));
  }
  refuse_deep_keys(content, path);
  toml::table table;
  try {
    table = toml::parse(content, path);
  } catch (const toml::parse_error& error) {
    throw InputError(
        fmt::format("{}:{}: {}", path, error.source().begin.line, error.description()));
  }
  std::vector<std::string> names;
  for (const StyleOption& option : style_options()) names.push_back(option.name);
  for (const auto& [key, node] : table) {
    const std::string place = fmt::format("{}:{}", path, key.source().begin.line);
    const auto option = std::find(names.begin(), names.end(), key.str());
    if (option == names.end()) {
      throw InputError(fmt::format("{}: a style has no key '{}'{}", place, key.str(),
                                   suggest_name(key.str(), names)));
    }
    const StyleOption& known = style_options()[static_cast<std::size_t>(option - names.begin())];
    const std::vector<std::string> texts = texts_of(node, known, place);
    try {
      known.set(texts, style);
    } catch (const InputError& error) {
      throw InputError(fmt::format("{}: {}: {}", place, known.name, error.what()));
    }
  }
}

}  // namespace gearsweep
