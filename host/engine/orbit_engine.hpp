// What an engine offers to the search for the periodic orbits that points settle on
// (tile/detail/orbit_search.hpp). States are [point of the tile][state], at phase 0.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "engine/result.hpp"
#include "engine/window.hpp"
#include "plan/plan.hpp"
#include "sweep_types.h"

namespace gearsweep {

struct TileResult;

// Called after each round with the integration steps that it took (a step with tangent vectors
// counts as what it costs); false asks the engine to stop.
using RoundCallback = std::function<bool(double steps)>;

// How near is near; distances are relative to the ranges of the motion.
struct NearReturn {
  double near;       // a state is near where it was n periods before within near / n^2
  double tolerance;  // distances that are looked at, at least: a range is so large that these do
                     // not drown in rounding
};

// The states of each point at the beginning of up to ORBIT_LONGEST periods and after each of them.
// They stay where the engine has them, in its precision: few of them are looked at.
class Sections {
 public:
  Sections() = default;
  // numbers: doubles where fp64, floats otherwise. Those of point i and period k begin at
  // first[i] + k * states * stride, one state in each stride.
  Sections(std::shared_ptr<const void> numbers, bool fp64, std::vector<std::size_t> first,
           std::size_t stride, std::size_t states)
      : numbers_(std::move(numbers)),
        fp64_(fp64),
        first_(std::move(first)),
        stride_(stride),
        states_(states) {}

  // period: 0 to ORBIT_LONGEST.
  std::vector<double> state(std::size_t point, std::size_t period) const {
    std::vector<double> out(states_);
    const std::size_t begin = first_[point] + period * states_ * stride_;
    for (std::size_t i = 0; i < states_; ++i) out[i] = number(begin + i * stride_);
    return out;
  }

 private:
  double number(std::size_t i) const {
    return fp64_ ? static_cast<const double*>(numbers_.get())[i]
                 : static_cast<const float*>(numbers_.get())[i];
  }

  std::shared_ptr<const void> numbers_;
  bool fp64_ = true;
  std::vector<std::size_t> first_;
  std::size_t stride_ = 1, states_ = 0;
};

struct Approach {
  std::vector<double> states;  // at the end
  Sections sections;           // the last one is number ORBIT_LONGEST
  // [point][state]: the largest range of a state of its group during the last period.
  std::vector<double> ranges;
  // [point]: the smallest number of periods before which the state was near where it is now; 0:
  // none.
  std::vector<std::uint32_t> lengths;
  std::vector<double> guesses;  // [point][state]: where the orbit of that length is likely to be
};

// The map from a state to the one some periods later.
struct ReturnMaps {
  std::vector<double> states;       // [point][state]
  std::vector<double> derivatives;  // [point][column][row]
};

// Periods of a study's settling that a search for orbits may take: what is left is the warm-up of
// the tangent vectors, which belongs to the record. None where the study looks at sections: their
// returns are counted in the whole record. None of a model with clocks, whose motion returns only
// where its frequencies agree.
inline std::size_t searched_periods(const Study& study) {
  const Integrate& integrate = study.integrate;
  if (!study.selection.watched_sections().empty() || study.model->clocks > 0) return 0;
  const bool warms_up = study.selection.tangent_count() > 0;
  return integrate.settle - (warms_up ? std::min(integrate.settle, integrate.warm_up) : 0);
}

// Whether a study's points are looked at on their orbits: to stop there, where it settles for long
// enough, or for the error of their exponents.
inline bool looks_for_orbits(const Study& study) {
  const bool searches =
      study.integrate.stop == Stop::orbit && searched_periods(study) >= ORBIT_LONGEST;
  return searches || study.selection.exponent_error.has_value();
}

class OrbitEngine {
 public:
  virtual ~OrbitEngine() = default;

  // Settles by so many periods, at most ORBIT_LONGEST. excluded: [point] bit n - 1: the state is
  // not compared with that n periods before.
  virtual std::optional<Approach> approach(const Plan& plan, const Tile& tile,
                                           const std::vector<double>& states, std::size_t periods,
                                           const std::vector<std::uint32_t>& excluded,
                                           const NearReturn& near,
                                           const RoundCallback& after_round) = 0;

  // The sections of each point through its own number of periods, lengths ([point], up to
  // ORBIT_LONGEST). Points of equal length are best neighbours.
  virtual std::optional<Sections> follow(const Plan& plan, const Tile& tile,
                                         const std::vector<double>& states,
                                         const std::vector<std::uint32_t>& lengths,
                                         const RoundCallback& after_round) = 0;

  // lengths: [point] periods of its map. Points of equal length are best neighbours.
  virtual std::optional<ReturnMaps> return_maps(const Plan& plan, const Tile& tile,
                                                const std::vector<double>& states,
                                                const std::vector<std::uint32_t>& lengths,
                                                const RoundCallback& after_round) = 0;

  // The verdicts on the window's record of a periodic orbit, of which one turn of `length` periods
  // is integrated and the rest is its repetition. log_stretchings is [point][tangent vector], the
  // same in each period. The other outputs and the samples are left empty or without meaning.
  virtual std::optional<TileResult> replay(const Plan& plan, const Tile& tile,
                                           const std::vector<double>& states, std::size_t length,
                                           const std::vector<double>& log_stretchings,
                                           const Window& window,
                                           const RoundCallback& after_round) = 0;
};

}  // namespace gearsweep
