// The maps that are made of all draws of uncertain parameters.
#pragma once

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
  sobol_total
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

// The dimension of Sobol indices.
inline constexpr const char* kUncertainDimension = "uncertain";

}  // namespace gearsweep
