// The page that a picture is plotted on: sizes, letters, and how gnuplot or LaTeX takes them.
// Lengths are in points (1/72 inch) from the lower left corner.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "plot/style.hpp"

namespace gearsweep {

enum class PictureFormat { kPng, kSvg, kPdf, kTex };

// By the ending. Throws InputError when it is none of .png, .svg, .pdf and .tex.
PictureFormat picture_format(const std::string& output_path);

// The part of a page that the axes enclose.
struct Frame {
  double left = 0.0, right = 0.0, bottom = 0.0, top = 0.0;
  double width() const { return right - left; }
  double height() const { return top - bottom; }
};

// The width that a picture is made for without a size, in mm.
inline constexpr double kUsualWidth = 120.0;

class Page {
 public:
  // usual_mm: the width that the picture is made for without a size. Throws InputError when the
  // style does not fit the format.
  Page(const PlotStyle& style, PictureFormat format, double usual_mm = kUsualWidth);

  // For a panel whose axes are not those that the style's limits and labels of x, y speak of.
  Page with_other_axes(bool x, bool y) const;

  const PlotStyle& style() const { return style_; }
  double width() const { return width_; }
  double em() const { return em_; }  // the font's size
  // What was asked for, or else so much.
  double height_or(double fallback) const { return height_ > 0.0 ? height_ : fallback; }
  // Whether a size was asked for; then nothing but the title stands above the picture.
  bool is_for_print() const { return style_.size.width > 0.0; }
  bool is_raster() const { return format_ == PictureFormat::kPng; }
  bool is_latex() const { return format_ == PictureFormat::kTex; }

  // A string of gnuplot that shows this markup.
  std::string text(std::string_view markup) const;
  // The width of what the markup shows, in points, as in a wide font.
  double width_of(std::string_view markup) const;
  // "set terminal ..." for a picture of this height, and what goes with it.
  std::string terminal(double height) const;
  // The same for a raster of points, of the inner part of a frame.
  std::string raster_terminal(const Frame& frame) const;
  std::pair<std::size_t, std::size_t> raster_size(const Frame& frame) const;  // pixels
  // "set" lines that put the axes there.
  std::string margins(const Frame& frame, double height) const;
  // Text at a place. `how`: "center", "left", "right", with "rotate by 90" and so on.
  std::string label_at(double x, double y, double height, std::string_view markup,
                       const std::string& how) const;

 private:
  PlotStyle style_;
  PictureFormat format_;
  double width_ = 0.0, height_ = 0.0, em_ = 0.0, dots_per_inch_ = 300.0;
};

// The ends of an axis that is plotted.
struct AxisRange {
  double min = 0.0, max = 1.0;
  bool logarithmic = false;
};

// The tics of an axis: at round numbers, with smaller ones between.
struct Tics {
  std::string lines;    // "set" lines
  double widest = 0.0;  // of the labels, in points
};

// Numbers stand closer to their axis than gnuplot puts them; in its letters.
std::string tic_offset(const std::string& axis);

// axis: "x", "y" or "y2"; length: of the axis, in points. Labels: whether the numbers are shown.
Tics tics_of(const Page& page, const std::string& axis, const AxisRange& range, double length,
             bool labels);

}  // namespace gearsweep
