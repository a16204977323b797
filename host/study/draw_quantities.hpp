// The maps that are made of all draws of uncertain parameters.
#pragma once

#include <optional>
#include <string>

#include "study/study.hpp"

namespace gearsweep {

// What such a map is of the values that a quantity has in a point's draws.
enum class DrawStatistic {
  mean,
  standard_deviation,
  percentile,
  share,        // of a class; of the status, too
  sobol_first,  // [uncertain parameter]
  sobol_first_error,
  sobol_total,
  each_value  // [draw] the values themselves
};

struct DrawQuantity {
  DrawStatistic statistic = DrawStatistic::mean;
  std::size_t source = 0;   // quantity of the study's selection; none of share of the status
  double percentile = 0.0;  // in percent
  int flag = 0;             // class
  bool of_status = false;
  Quantity quantity;  // as the study's selection has it
};

// Whether a quantity has maps of the draws: one of several numbers or of attractors has none.
bool has_draw_quantities(const Quantity& quantity);

// All that a study with uncertain parameters has, in order.
std::vector<DrawQuantity> draw_quantities(const Study& study);

// Adds them to the study's selection.
void add_draw_quantities(Study* study);

// The percentile, in percent, that a map of this name is of the quantity: 2.5 of "x_rms_p2_5" and
// "x_rms". Nothing of other names.
std::optional<double> percentile_in(const std::string& name, const std::string& quantity);

// The dimension of Sobol indices.
inline constexpr const char* kUncertainDimension = "uncertain";

// The dimension of the values in each draw.
inline constexpr const char* kDrawDimension = "draw";

}  // namespace gearsweep
