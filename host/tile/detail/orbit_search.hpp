// Settles a tile and takes out the points that arrive on a periodic orbit.
//
// Every ORBIT_LONGEST periods, or after fewer at first, each point's state is compared with where
// it was. Where it is nearly back after some number of periods, its last returns are extrapolated
// to the periodic orbit that they tend to, and Newton's method (shooting) goes on from there. When
// there is an orbit and its multipliers over its minimal period say that it is stable, the point's
// last returns and its next ones are compared with it, and when they are seen to converge to it,
// the point need not be integrated any longer. The step's derivative gives all multipliers, and so
// all Lyapunov exponents.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "engine/engine.hpp"
#include "tile/detail/orbit_convergence.hpp"
#include "tile/detail/orbit_pursuit.hpp"

namespace gearsweep {

struct FoundOrbit {
  std::size_t position = 0;  // of the point in the tile
  std::uint32_t length = 0;  // periods of the forcing that it takes to come back
  std::size_t settled = 0;   // periods integrated before this state
  std::vector<double> state;
  std::vector<double> log_stretchings;  // log |multiplier| per forcing period, largest first
};

// What a search takes for an orbit that a point may be on its way to. Distances are relative to the
// motion's ranges.
struct SearchCriteria {
  double near = 0.0;     // of a return from where it was: from there Newton's method is tried
  double far = 0.0;      // of the orbit from where Newton's method begins, at most
  int longest_span = 0;  // returns by which a convergence is judged (orbit_convergence.hpp)
  double kept = 0.0;     // as of NewtonLimits
};

class OrbitSearch {
 public:
  // initial: [point of the tile][state]. Looks for so many periods at most. The orbits that it
  // finds are those of orbit_plan, the same points with steps as short as `plan`'s or shorter.
  // `engine` (null: there is nothing that could look) and the others outlive the search.
  OrbitSearch(const Plan& plan, const Plan& orbit_plan, const Tile& tile,
              const std::vector<double>& initial, std::size_t periods, OrbitEngine* engine);

  // Whether another advance() stays within these periods, and there is a point to settle. Never
  // with stop = "never".
  bool can_advance() const;

  // Settles the open points by ORBIT_LONGEST periods, or by fewer at first, where they start so
  // near an orbit that fewer may tell. False when the callback asked to stop.
  bool advance(const RoundCallback& after_round);

  std::size_t settled() const { return settled_; }  // periods so far
  // Those that were taken out of the open points so far, as they were found.
  const std::vector<FoundOrbit>& found() const { return found_; }
  // Positions of those that have diverged since the search began; they are no longer open.
  const std::vector<std::size_t>& diverged() const { return diverged_; }
  const std::vector<std::size_t>& open() const { return open_; }  // positions
  const std::vector<double>& states() const { return states_; }   // [open point][state]

 private:
  // An orbit that a point may be on its way to.
  struct Candidate {
    OrbitAttempt orbit;
    std::size_t settled;           // periods integrated before orbit.newton.start
    OrbitConvergence convergence;  // of the trajectory's returns to the orbit
    OrbitConvergence::Verdict verdict = OrbitConvergence::Verdict::open;
  };

  std::size_t next_approach() const;  // periods
  std::vector<OrbitAttempt> attempts_from(const Approach& approach) const;
  // Looks for orbits that open points without a candidate may be on their way to. False when the
  // callback asked to stop.
  bool find_candidates(const Approach& approach, const RoundCallback& after_round);
  // Shows the candidates the sections of the approach that has just ended.
  void watch(const Sections& sections, std::size_t periods);
  // Takes over the candidates that are arrived at, and gives up those that are not. False when the
  // callback asked to stop.
  bool take_arrivals(const RoundCallback& after_round);
  // Takes orbits from the steps of the search to those of orbit_plan. One that is not there, or not
  // stable, is no longer found.
  bool refine(const OrbitPursuit::Attempts& arrivals, const RoundCallback& after_round);
  void close_points();

  const Plan& plan_;
  const Plan& orbit_plan_;
  const Tile& tile_;
  const std::size_t periods_;  // of the search, at most
  OrbitEngine* engine_;
  const bool is_near_nominal_;  // a draw that starts from the nominal motion
  const SearchCriteria criteria_;
  std::size_t settled_ = 0;
  std::vector<std::size_t> open_;
  std::vector<double> states_;
  std::vector<std::uint32_t> hopeless_;  // [point of the tile] bit n - 1: not this length again
  std::vector<std::size_t> next_try_;    // [point of the tile] not before so many periods
  std::vector<std::uint8_t> is_found_;   // [point of the tile]
  std::vector<std::unique_ptr<Candidate>> candidates_;  // [point of the tile] or none
  std::vector<FoundOrbit> found_;
  std::vector<std::size_t> diverged_;
};

}  // namespace gearsweep
