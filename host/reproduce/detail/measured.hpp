// What `gearsweep reproduce` measures: the maps and time histories of the built-in studies of one
// preset.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/trace.hpp"
#include "sweep/sweep.hpp"

namespace gearsweep {

// One quantity of a study of one axis.
class MapCurve {
 public:
  MapCurve(const SweepResult& result, const std::string& quantity);

  std::size_t size() const { return x_.size(); }
  double x(std::size_t i) const { return x_[i]; }
  double operator[](std::size_t i) const { return values_[i]; }
  const std::vector<double>& values() const { return values_; }

  // Where the largest value with from <= x <= to is. Throws std::logic_error when there is none.
  std::size_t max_in(double from, double to) const;
  // The indices with from <= x <= to.
  std::vector<std::size_t> within(double from, double to) const;
  std::size_t nearest(double x) const;

 private:
  std::vector<double> x_, values_;
};

// The share of `points` at which `is_so` holds, 0 for no points.
double share_of(const std::vector<std::size_t>& points,
                const std::function<bool(std::size_t)>& is_so);

// Amplitude of a channel at a multiple of the mesh frequency, over all of the trace, which must be
// whole periods of that: the Fourier coefficient by the trapezoidal rule between its moments.
double amplitude_at(const Trace& trace, const std::string& channel, double order);

// Smallest and largest value of a channel.
std::pair<double, double> range_of(const Trace& trace, const std::string& channel);

struct MeasuredFigures {
  std::string preset;
  std::vector<std::string> overrides;                // what each study has in place of the preset's
  std::map<std::string, SweepResult> maps;           // by figure: "fig4"
  std::map<std::string, std::vector<Trace>> traces;  // of a figure's points, in their order
  // Where the largest force of figures 7 and 10 passes 0.6 from one half backlash to the next, and
  // how many attractors an ensemble of initial states reaches at both.
  struct Jump {
    double below = 0.0, above = 0.0;
    std::size_t count_below = 0, count_above = 0;
    bool is_change_of_basin() const { return count_below > 1 && count_above > 1; }
  };
  std::map<std::string, std::vector<Jump>> jumps;  // by figure, ascending; empty: nothing jumps
  // A picture of basins beside a figure's first jump: attractors that it shows, and those that the
  // ensemble reaches at the same half backlash.
  struct Basins {
    std::string figure;
    double b = 0.0;
    std::size_t shown = 0, counted = 0;
  };
  std::vector<Basins> basins;
  // Largest relative change of the energy in three periods, undamped and unforced, in contact.
  double drift_consistent = 0.0, drift_printed = 0.0;
};

}  // namespace gearsweep
