// Maps over the draws of uncertain parameters.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/engine.hpp"
#include "study/draw_quantities.hpp"

namespace gearsweep {

// Keeps what quantities have in each draw until all are there.
class DrawMaps {
 public:
  // The study has uncertain parameters and outlives this.
  explicit DrawMaps(const Study& study);

  // trajectory: draw n (from 1) of point p is n * study.points() + p. position: in the tile.
  void add(const Plan& plan, std::size_t trajectory, const TileResult& result,
           std::size_t position);

  // values: [quantity of the study's selection][point * its width + i]; those of draws are filled
  // in. A draw that diverged counts in the share of these alone; a point all of whose draws did has
  // no other value.
  void reduce(std::vector<std::vector<double>>* values) const;

 private:
  double diverged_share(std::size_t point) const;
  void reduce_source(std::size_t point, std::size_t source,
                     std::vector<std::vector<double>>* values) const;

  const Study& study_;
  std::vector<std::size_t> sources_;       // quantities of the selection that are kept
  std::vector<std::vector<double>> kept_;  // [source][point * draws + draw]; NaN: none
  std::vector<std::uint8_t> is_ok_;        // [point * draws + draw]
  std::vector<DrawQuantity> quantities_;
  std::vector<std::size_t> targets_;  // [of quantities_] the quantity of the selection
};

// Linear between the sorted numbers, as numpy.percentile has it. percentile in 0 .. 100.
double percentile_of(const std::vector<double>& sorted, double percentile);

// Sobol indices of one quantity.
struct SobolIndices {
  std::vector<double> first, first_error, total;  // one for each parameter
};

// values: of Saltelli's matrices A, B, and A with each column of B, `samples` numbers each; NaN:
// none, and then the sample counts nowhere. First order by Saltelli et al. (Computer Physics
// Communications 181 (2010) 259-270, Table 2 (b)), of deviations from the mean; total by Jansen
// (1999). The error is the standard error of the mean that the estimate is.
SobolIndices sobol_indices(const std::vector<double>& values, std::size_t samples,
                           std::size_t parameters);

}  // namespace gearsweep
