// How a picture looks: what options of the command line and keys of a style file say.
#pragma once

#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace gearsweep {

inline constexpr double kMmPerInch = 25.4;

struct PictureSize {
  double width = 0.0;   // of the whole picture; 0: not given
  double height = 0.0;  // 0: what suits the picture
  bool in_pixels = false;
};

// Ends of an axis or of the colours; what is not given follows the values.
struct Limits {
  std::optional<double> min, max;
};

struct Contours {
  std::size_t count = 0;  // so many levels between the ends of the colours
  std::vector<double> levels;
  bool any() const { return count > 0 || !levels.empty(); }
};

// Everything has a default; an empty title leaves the title out. What a style file says and does
// not concern a picture (such as contours for a curve) is left aside, so that one style serves
// many.
struct PlotStyle {
  PictureSize size;  // in mm, or in pixels
  std::string font = "DejaVu Sans";
  double font_size = 0.0;  // in points; 0: 8 at print sizes up to 100 mm, else 9
  std::optional<std::string> title, xlabel, ylabel, label;
  // What the quantity, or the signal of an order map, is called where its name says too little. Of
  // no option.
  std::optional<std::string> words;
  std::vector<std::string> legend;
  Limits xrange, yrange, range;
  std::string colormap;  // one of colormap_names(); empty: what suits the map
  bool is_log = false;
  Contours contours;
  bool has_units = false;  // the next was asked for; otherwise SI where there are scales
  bool is_si = false;
  bool has_band = true;            // of tolerances, where there is one
  std::set<std::string> demanded;  // options of the command line: they must concern the picture

  // Throws InputError when the option was given for a picture that it does not concern. why: "'x'
  // is a map of classes".
  void refuse(const std::string& option, const std::string& why) const;
  // The same where a band was asked for, in a picture without.
  void refuse_band() const;
};

// An option of the command line, which is a key of style files too.
struct StyleOption {
  std::string name;     // "xrange"
  std::string value;    // "LO:HI"; empty: a flag
  std::string meaning;  // for help
  bool is_list = false;
  // Throws InputError with what would be right. A flag is given "true" or "false".
  std::function<void(const std::vector<std::string>&, PlotStyle*)> set;
  // A list may be a number alone, which says how many; a list of one number has an empty text
  // behind it.
  bool may_count = false;
};

// In the order in which help shows them.
const std::vector<StyleOption>& style_options();

// Sets what the keys of a TOML file say. Throws InputError with file and line for an unknown key, a
// wrong type or a wrong value.
void read_style_file(const std::string& path, PlotStyle* style);

}  // namespace gearsweep
