#include "plot/detail/page.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "model/error.hpp"
#include "plot/detail/latex.hpp"
#include "plot/detail/text.hpp"

namespace gearsweep {
namespace {

constexpr double kPointsPerInch = 72.0;
constexpr double kSvgPixelsPerInch = 96.0;
// What gnuplot's lengths are in its own units: its letters in points of 1/96 inch, the diameter of
// a point of size 1.
constexpr double kLetterScale = 96.0 / 72.0, kPointDiameter = 6.0;
constexpr double kRasterPerInch = 400.0;  // of dots, at most
constexpr double kMaxPixels = 1.2e6;      // of which dots make some 400 kB
constexpr double kLine = 0.5;             // points that linewidth 1 is wide
constexpr double kDot = 2.0;              // points across of pointsize dot

// Pixels of dots per point.
double raster_scale(const Frame& frame) {
  return std::min(kRasterPerInch / kPointsPerInch,
                  std::sqrt(kMaxPixels / (frame.width() * frame.height())));
}

double points_of(double mm) { return mm / kMmPerInch * kPointsPerInch; }

}  // namespace

PictureFormat picture_format(const std::string& output_path) {
  if (output_path.ends_with(".png")) return PictureFormat::kPng;
  if (output_path.ends_with(".svg")) return PictureFormat::kSvg;
  if (output_path.ends_with(".pdf")) return PictureFormat::kPdf;
  if (output_path.ends_with(".tex")) return PictureFormat::kTex;
  throw InputError(
      fmt::format("cannot draw '{}': its name must end in .png, .svg, .pdf or .tex", output_path));
}

Page::Page(const PlotStyle& style, PictureFormat format, double usual_mm)
    : style_(style), format_(format) {
  const PictureSize& size = style.size;
  width_ = points_of(usual_mm);
  if (size.width > 0.0 && !size.in_pixels) {
    width_ = points_of(size.width);
    height_ = points_of(size.height);
  } else if (size.width > 0.0) {
    if (format == PictureFormat::kPdf || format == PictureFormat::kTex) {
      throw InputError(
          "pixels are for .png and .svg; give the size of this picture in mm, as in 85x64mm");
    }
    // So many pixels of the picture that is plotted without a size.
    dots_per_inch_ =
        format == PictureFormat::kPng ? size.width / (usual_mm / kMmPerInch) : kSvgPixelsPerInch;
    width_ = size.width / dots_per_inch_ * kPointsPerInch;
    height_ = size.height / dots_per_inch_ * kPointsPerInch;
  }
  constexpr double kNarrow = 101.0, kSmallLetters = 8.0, kLetters = 9.0;
  em_ = style.font_size > 0.0          ? style.font_size
        : width_ <= points_of(kNarrow) ? kSmallLetters
                                       : kLetters;
}

Page Page::with_other_axes(bool x, bool y) const {
  Page page = *this;
  if (x) {
    page.style_.xlabel.reset();
    page.style_.xrange = {};
  }
  if (y) {
    page.style_.ylabel.reset();
    page.style_.yrange = {};
  }
  return page;
}

std::string Page::text(std::string_view markup) const {
  if (is_latex()) return quote(latex_of(markup));
  std::string shown(markup);
  if (format_ != PictureFormat::kSvg) return quote(shown);
  // Some viewers drop a blank at the ends of an element of SVG, so an empty letter stands there.
  constexpr std::string_view kEmpty = "\u200b";
  for (std::size_t at = 0; (at = shown.find(' ', at)) != std::string::npos; ++at) {
    const bool is_before = at + 1 < shown.size() && shown[at + 1] == '{';
    const bool is_after = at > 1 && shown[at - 1] == '}' && shown[at - 2] != '\\';
    if (is_before) shown.insert(at + 1, kEmpty);
    if (is_after) shown.insert(at, kEmpty);
    if (is_after) at += kEmpty.size();
  }
  return quote(shown);
}

double Page::width_of(std::string_view markup) const { return em_ * letters_width(markup); }

std::string Page::terminal(double height) const {
  const double scale = dots_per_inch_ / kPointsPerInch;  // pixels per point
  const std::string common =
      fmt::format("font '{},{:.6g}' rounded background 'white'", style_.font, em_);
  switch (format_) {
    case PictureFormat::kPng:
      return fmt::format(
          "set terminal pngcairo size {:.0f},{:.0f} {} fontscale {:.6g} linewidth {:.6g}\n"
          "dot = {:.6g}\ntic = 0.7\n",
          width_ * scale, height * scale, common, scale / kLetterScale, kLine * scale,
          kDot * scale / kPointDiameter);
    case PictureFormat::kSvg:
      return fmt::format(
          "set terminal svg size {:.0f},{:.0f} font '{},{:.6g}' rounded background 'white' "
          "linewidth {:.6g}\ndot = {:.6g}\ntic = 0.45\n",
          width_ * kLetterScale, height * kLetterScale, style_.font, em_ * kLetterScale,
          kLine * kLetterScale, kDot * kLetterScale / kPointDiameter);
    case PictureFormat::kPdf:
      return fmt::format(
          "set terminal pdfcairo size {:.5g}in,{:.5g}in {} fontscale 0.75 linewidth {:.6g}\n"
          "dot = {:.6g}\ntic = 0.7\n",
          width_ / kPointsPerInch, height / kPointsPerInch, common, kLine / 0.5,
          kDot / kPointDiameter);
    case PictureFormat::kTex:
      return fmt::format(
          "set terminal cairolatex pdf input size {:.5g}in,{:.5g}in "
          "header '\\fontsize{{{}}}{{{}}}\\selectfont' font ',{}' fontscale 0.75 rounded "
          "linewidth {:.6g}\ndot = {:.6g}\ntic = 0.7\n",
          width_ / kPointsPerInch, height / kPointsPerInch, em_, 1.2 * em_, em_, kLine / 0.25,
          kDot / kPointDiameter);
  }
  return "";
}

std::pair<std::size_t, std::size_t> Page::raster_size(const Frame& frame) const {
  const double scale = raster_scale(frame);
  return {static_cast<std::size_t>(std::max(2.0, std::round(frame.width() * scale))),
          static_cast<std::size_t>(std::max(2.0, std::round(frame.height() * scale)))};
}

std::string Page::raster_terminal(const Frame& frame) const {
  const auto [columns, rows] = raster_size(frame);
  const double scale = raster_scale(frame);
  return fmt::format(
      "set terminal pngcairo size {},{} background 'white' linewidth {:.6g}\ndot = {:.6g}\n",
      columns, rows, kLine * scale, kDot * scale / kPointDiameter);
}

std::string Page::margins(const Frame& frame, double height) const {
  return fmt::format(
      "set lmargin at screen {:.5f}\nset rmargin at screen {:.5f}\n"
      "set bmargin at screen {:.5f}\nset tmargin at screen {:.5f}\n",
      frame.left / width_, frame.right / width_, frame.bottom / height, frame.top / height);
}

std::string Page::label_at(double x, double y, double height, std::string_view markup,
                           const std::string& how) const {
  if (markup.empty()) return "";
  return fmt::format("set label {} at screen {:.5f}, screen {:.5f} {}\n", text(markup), x / width_,
                     y / height, how);
}

namespace {

struct Tic {
  double place = 0.0;
  std::string text;  // empty: a small one
};

std::string number_text(double value, int decimals) {
  std::string text = fmt::format("{:.{}f}", value, decimals);
  if (text.starts_with('-')) text = "−" + text.substr(1);
  return text;
}

// Digits and, if need be, a power of ten.
std::string scientific_text(double value, double step) {
  if (value == 0.0) return "0";
  const double exponent = std::floor(std::log10(std::abs(value)) + 1e-9);
  const double mantissa = value / std::pow(10.0, exponent);
  const int decimals =
      std::clamp(static_cast<int>(std::ceil(exponent - std::log10(step) - 1e-9)), 0, 6);
  return fmt::format("{}·10^{{{}}}", number_text(mantissa, decimals), number_text(exponent, 0));
}

// Tics at multiples of `step`, with `small` parts between them.
std::vector<Tic> even_tics(const AxisRange& range, double step, int small) {
  const double max = std::max(std::abs(range.min), std::abs(range.max));
  const bool is_plain = max < 1e5 && step >= 1e-4;
  const int decimals = std::max(0, static_cast<int>(std::ceil(-std::log10(step) - 1e-9)));
  const double fine = step / small;
  const double first = std::ceil(range.min / fine - 1e-6);
  const double last = std::floor(range.max / fine + 1e-6);
  std::vector<Tic> tics;
  constexpr double kMax = 1000.0;  // where rounding leaves the ends far apart
  for (double i = first; i <= last && i < first + kMax; i += 1.0) {
    const bool is_major = std::abs(std::remainder(i, small)) < 0.5;
    const double place = i == 0.0 ? 0.0 : i * fine;  // not -0
    tics.push_back({place, !is_major  ? ""
                           : is_plain ? number_text(place, decimals)
                                      : scientific_text(place, step)});
  }
  return tics;
}

// The finest round steps whose numbers stand apart, but not so many that nobody reads them.
std::vector<Tic> even_tics(const Page& page, const AxisRange& range, double length,
                           bool is_upright) {
  constexpr double kMax = 8.0;
  const double span = range.max - range.min;
  if (!(span > 0.0 && std::isfinite(span))) return {};
  const double unit = std::pow(10.0, std::floor(std::log10(span)) - 1.0);
  std::vector<Tic> coarser;
  for (const double factor : {50.0, 20.0, 10.0, 5.0, 2.0, 1.0}) {
    const double step = unit * factor;
    std::vector<Tic> tics = even_tics(range, step, factor == 20.0 || factor == 2.0 ? 4 : 5);
    double widest = 0.0;
    std::size_t majors = 0;
    for (const Tic& tic : tics) {
      if (tic.text.empty()) continue;
      ++majors;
      widest = std::max(widest, page.width_of(tic.text));
    }
    const double room = is_upright ? 1.9 * page.em() : widest + 0.9 * page.em();
    const bool fits = length * step / span >= room && span / step <= kMax;
    if (!fits && majors >= 2 && !coarser.empty()) return coarser;
    coarser = std::move(tics);
    if (!fits && majors >= 2) return coarser;
  }
  return coarser;
}

std::vector<Tic> logarithmic_tics(const AxisRange& range, std::size_t most) {
  const double low = std::floor(std::log10(range.min) + 1e-9);
  const double high = std::ceil(std::log10(range.max) - 1e-9);
  const double decades = std::log10(range.max / range.min);
  const double every = std::max(1.0, std::ceil(decades / static_cast<double>(most)));
  std::vector<Tic> tics;
  for (double exponent = low; exponent <= high; exponent += 1.0) {
    for (int digit = 1; digit < 10; ++digit) {
      const double place = digit * std::pow(10.0, exponent);
      if (place < range.min * (1 - 1e-9) || place > range.max * (1 + 1e-9)) continue;
      const bool has_room = decades < 0.7   ? true
                            : decades < 2.0 ? digit == 1 || digit == 2 || digit == 5
                                            : digit == 1;
      const bool is_major = has_room && std::remainder(exponent, every) == 0.0;
      if (!is_major && every > 1.0 && digit != 1) continue;
      const bool is_plain = exponent >= -3.0 && exponent < 4.0;
      const int decimals = std::max(0, static_cast<int>(-exponent));
      tics.push_back({place, !is_major  ? ""
                             : is_plain ? number_text(place, decimals)
                                        : scientific_text(place, place)});
    }
  }
  return tics;
}

}  // namespace

std::string tic_offset(const std::string& axis) {
  return axis == "x" ? "0,0.35" : axis == "y" ? "0.6,0" : "-0.6,0";
}

Tics tics_of(const Page& page, const std::string& axis, const AxisRange& range, double length,
             bool labels) {
  const bool is_upright = axis != "x";
  const double room = (is_upright ? 2.2 : 4.2) * page.em();
  const auto most = static_cast<std::size_t>(std::clamp(length / room, 2.0, 9.0));
  const std::vector<Tic> tics = range.logarithmic ? logarithmic_tics(range, most)
                                                  : even_tics(page, range, length, is_upright);
  Tics out;
  std::vector<std::string> words;
  for (const Tic& tic : tics) {
    if (!tic.text.empty()) out.widest = std::max(out.widest, page.width_of(tic.text));
    const std::string shown = labels && !tic.text.empty() ? page.text(tic.text) : "\"\"";
    words.push_back(fmt::format("{} {:.10g} {}", shown, tic.place, tic.text.empty() ? 1 : 0));
  }
  if (!labels) out.widest = 0.0;
  out.lines = fmt::format("{}set {}tics out nomirror scale tic,tic/2 offset {} ({})\n",
                          range.logarithmic ? fmt::format("set logscale {}\n", axis) : "", axis,
                          tic_offset(axis), fmt::join(words, ", "));
  return out;
}

}  // namespace gearsweep
