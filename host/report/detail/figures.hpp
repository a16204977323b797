// The pictures of a report. Those of two studies have the same axes, so that they can be compared.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "report/detail/findings.hpp"
#include "report/detail/html.hpp"

namespace gearsweep {

struct FigureRequest {
  std::string name;                // of the picture's file
  std::vector<std::string> files;  // of the findings
  std::string quantity;
  bool is_map = false;                    // over both axes
  std::vector<std::string> legend = {};   // what several files are called
  double height = 51.0;                   // mm, the same for all that stand beside each other
  std::optional<std::string> words = {};  // at the axis, if not those of the quantity
};

// A picture with a key below it is as high as this.
inline constexpr double kFigureHeightWithKey = 57.0;  // mm

// One for each study. caption: HTML.
std::vector<HtmlFigure> figures_of(const Sides& sides, const FigureRequest& request,
                                   const std::string& caption);

// The order maps.
std::vector<HtmlFigure> order_figures(const Sides& sides, const std::string& caption);

}  // namespace gearsweep
