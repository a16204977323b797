// What tolerances make of a gear over speed: the numbers of a tolerance report.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/result.hpp"
#include "report/tolerance_report.hpp"
#include "result/output_file.hpp"
#include "result/result_file.hpp"
#include "study/as_built.hpp"

namespace gearsweep {

// A percentile of independent draws.
struct Percentile {
  double value = 0.0;
  double error = 0.0;  // half the width of its 95 % interval
};

// What each draw of each point has: [point][draw]; NaN: no value. The study keeps it.
std::vector<std::vector<double>> draws_of_points(const SweepResult& result,
                                                 const std::string& quantity);

// numbers: NaN counts as none. The interval is that of the ranks that a binomial distribution gives
// (normal approximation). Where it needs more numbers than there are, the error is infinite.
Percentile percentile_with_error(std::vector<double> numbers, double percentile);

struct WorstGear {
  std::size_t draw = 0;   // from 0
  std::size_t point = 0;  // its worst speed
  double value = 0.0;
  std::vector<std::string> overrides;  // that make the study this gear
};

struct RankedTolerance {
  std::string name;
  double first = 0.0, first_error = 0.0, total = 0.0;  // Sobol indices at the worst speed
  std::optional<double> tightened;  // the percentile there when it is half as wide
};

struct Scatter : AsBuilt {
  SweepResult result;                   // the values in each draw included
  std::size_t worst = 0;                // the speed with the largest percentile
  std::vector<Percentile> percentiles;  // [speed] of the target
  // [speed] share of the gears that lose contact there, and that at any speed; empty of a model
  // without contact classes. Gears without a value count in neither.
  std::vector<double> parting;
  double parting_anywhere = 0.0;
  // Gears that have no value at some speed (they diverge, or outgrow their step); they count in no
  // percentile there.
  std::size_t without_value = 0;
  std::vector<WorstGear> worst_gears;  // at most ten
  std::vector<RankedTolerance> ranking;
  std::size_t tightened_gears = 0;  // the first ones, by which `tightened` is told
  std::unique_ptr<TemporaryFolder> folder = std::make_unique<TemporaryFolder>();

  std::string file(const std::string& stored) const { return (folder->path() / stored).string(); }
  std::size_t gears() const { return study.uncertain.samples; }
  // A map of `result` over the speed, in SI units where these are known.
  ResultMap map(const std::string& quantity) const;
  // What its numbers in `result` are multiplied by there.
  double scale_of(const std::string& quantity) const;
};

// Nothing when stopped. Reads and writes no file but the journals.
std::optional<Scatter> find_scatter(const Study& study, const ToleranceOptions& options);

}  // namespace gearsweep
