#include "tile/tile_run.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <tuple>

#include "model/on_all_cores.hpp"
#include "plan/step_check.hpp"
#include "plan/unstable_start.hpp"
#include "sweep_types.h"
#include "tile/detail/exponent_error.hpp"
#include "tile/detail/largest_exponent.hpp"
#include "tile/detail/longer_window.hpp"
#include "tile/detail/orbit_search.hpp"
#include "tile/subset.hpp"

namespace gearsweep {
namespace {

// How often an orbit of this many periods is gone through, so that the waves of all orders fit: the
// smallest number that does, or as often as fits into the record.
std::size_t turns_of_orders(const std::vector<double>& orders, std::size_t length,
                            std::size_t record) {
  const std::size_t most = std::max<std::size_t>(record / length, 1);
  for (std::size_t turns = 1; turns < most; ++turns) {
    const auto periods = static_cast<double>(turns * length);
    const bool all_fit = std::ranges::all_of(orders, [&](double order) {
      const double waves = order * periods;
      return std::abs(waves - std::round(waves)) < 1e-6;
    });
    if (all_fit) return turns;
  }
  return most;
}

class TileRun {
 public:
  TileRun(const Plan& plan, const Tile& tile, Engine* engine, const TileCallbacks& callbacks)
      : plan_(plan),
        study_(plan.study()),
        orbit_plan_(plan.with_shorter_steps(study_.integrate.orbit_steps)),
        tile_(tile),
        engine_(engine),
        callbacks_(callbacks),
        windows_(windows_of(study_)),
        result_(empty_result(study_, tile.points.size())),
        has_stopped_(tile.points.size(), 0),
        is_orbit_(tile.points.size(), 0) {}

  std::optional<TileResult> run(const std::vector<double>& initial) {
    const bool finished = search_for_orbits(initial) && record_the_rest() && extend() &&
                          add_exponent_errors(plan_, orbit_plan_, tile_, has_stopped_, is_orbit_,
                                              engine_->orbits(), callbacks_.after_round, &result_);
    if (!finished) return std::nullopt;
    complete_largest_exponents(plan_, tile_, &result_);
    mark_unstable_starts(initial);
    refuse_long_steps();
    result_.cost.stopped =
        static_cast<double>(std::count(has_stopped_.begin(), has_stopped_.end(), 1));
    result_.on_orbit = std::move(has_stopped_);
    return std::move(result_);
  }

 private:
  void mark_unstable_starts(const std::vector<double>& initial) {
    if (!plan_.is_autonomous()) return;
    const std::size_t states = study_.model->states.size();
    for (std::size_t i = 0; i < tile_.points.size(); ++i) {
      const auto start = initial.begin() + static_cast<std::ptrdiff_t>(i * states);
      const std::vector<double> x(start, start + static_cast<std::ptrdiff_t>(states));
      if (result_.status[i] != STATUS_ok || !starts_unstable(plan_, tile_.points[i], x)) continue;
      result_.status[i] = STATUS_unstable_start;
    }
  }

  // The numbers of such points are those of the method.
  void refuse_long_steps() {
    if (study_.step_reach.low.empty()) return;
    const std::size_t points = tile_.points.size();
    std::vector<std::uint8_t> is_too_long(points);
    for_each_on_all_cores(points, [&](std::size_t i) {
      const std::span<const double> end = result_.state_table()[i];
      is_too_long[i] = result_.status[i] == STATUS_ok &&
                       has_outgrown_step(plan_, tile_.points[i], {end.begin(), end.end()});
    });
    for (std::size_t i = 0; i < points; ++i) {
      if (is_too_long[i] == 0) continue;
      result_.status[i] = STATUS_step_too_long;
      blank_point(i, &result_);
    }
  }

  // The functions below that return a bool return false when the callback asked to stop.

  bool search_for_orbits(const std::vector<double>& initial) {
    OrbitSearch search(plan_, orbit_plan_, tile_, initial, searched_periods(study_),
                       engine_->orbits());
    while (search.can_advance()) {
      const std::size_t before = search.found().size();
      if (!search.advance(callbacks_.after_round)) return false;
      count_as_saved(search, before);
    }
    if (!record_orbits(search.found())) return false;
    for (const std::size_t position : search.diverged()) {
      result_.status[position] = STATUS_diverged;
      blank_point(position, &result_);
    }
    open_ = search.open();
    states_ = search.states();
    settled_ = search.settled();
    return true;
  }

  // The orbits from number `first` on are found: the steps that were planned for the rest of their
  // window will not be needed.
  void count_as_saved(const OrbitSearch& search, std::size_t first) {
    const Window& whole = windows_.front();
    const auto periods = static_cast<double>(whole.settle - search.settled() + whole.record);
    double steps = 0.0;
    for (std::size_t i = first; i < search.found().size(); ++i) {
      steps += static_cast<double>(plan_.steps_of(tile_.points[search.found()[i].position]));
    }
    callbacks_.on_work(-steps * periods);
  }

  // Orbits of the same length are recorded together, however early each was found.
  bool record_orbits(std::vector<FoundOrbit> orbits) {
    std::sort(orbits.begin(), orbits.end(), [](const FoundOrbit& a, const FoundOrbit& b) {
      return std::tie(a.length, a.position) < std::tie(b.length, b.position);
    });
    for (auto first = orbits.begin(); first != orbits.end();) {
      const auto last = std::find_if(first, orbits.end(), [&](const FoundOrbit& orbit) {
        return orbit.length != first->length;
      });
      if (!record_alike({first, last})) return false;
      first = last;
    }
    return true;
  }

  // A run through the whole window would begin to record at one of the orbit's sections. This many
  // periods lie between the orbit's state and that section.
  std::size_t phase_offset_of(const FoundOrbit& orbit) const {
    return (windows_.front().settle - orbit.settled) % orbit.length;
  }

  // The orbits' states at those sections; nothing when the callback asked to stop.
  std::optional<std::vector<double>> first_recorded(const std::vector<FoundOrbit>& orbits,
                                                    const Tile& subset) {
    std::vector<double> states;
    std::vector<std::uint32_t> offsets;
    for (const FoundOrbit& orbit : orbits) {
      states.insert(states.end(), orbit.state.begin(), orbit.state.end());
      offsets.push_back(static_cast<std::uint32_t>(phase_offset_of(orbit)));
    }
    if (std::ranges::max(offsets) == 0) return states;
    callbacks_.on_work(orbit_plan_.steps_of(subset.points, offsets));
    const std::optional<Sections> sections =
        engine_->orbits()->follow(orbit_plan_, subset, states, offsets, callbacks_.after_round);
    if (!sections) return std::nullopt;
    states.clear();
    for (std::size_t i = 0; i < orbits.size(); ++i) {
      const std::vector<double> state = sections->state(i, offsets[i]);
      states.insert(states.end(), state.begin(), state.end());
    }
    return states;
  }

  bool judges_sections() const {
    return std::ranges::any_of(study_.selection.observers, [](const Observer& observer) {
      return observer.observable->role == ObservableRole::verdict;
    });
  }

  // Two passes: in the first, observers of states and signals see one turn of the orbit, or so many
  // that the waves of the orders fit; in the second, observers of tangents and sections see one
  // turn repeated for the whole record. Where there are none of these, the first tells all.
  bool record_alike(const std::vector<FoundOrbit>& orbits) {
    const std::size_t length = orbits.front().length;
    std::vector<std::size_t> positions;
    std::vector<double> log_stretchings;
    const std::size_t tangents = study_.selection.tangent_count();
    for (const FoundOrbit& orbit : orbits) {
      positions.push_back(orbit.position);
      const auto first = orbit.log_stretchings.begin();
      log_stretchings.insert(log_stretchings.end(), first,
                             first + static_cast<std::ptrdiff_t>(tangents));
    }
    const Window& whole = windows_.front();
    const std::size_t recorded =
        length * turns_of_orders(study_.selection.orders, length, whole.record);
    // The whole record ends at the section where one turn does, or takes a part of a turn more.
    const bool is_told = !judges_sections() && whole.record % length == 0;
    const Tile subset = subset_of(orbit_plan_, tile_, positions, recorded + (is_told ? 0 : length));
    callbacks_.on_work(subset.work);
    const std::optional<std::vector<double>> states = first_recorded(orbits, subset);
    if (!states) return false;
    // The verdicts of this window are replaced by those of the next.
    const Window turn = {.record = recorded, .samples = whole.samples > 0 ? length : 0};
    std::optional<TileResult> once =
        engine_->compute(orbit_plan_, subset, *states, turn, callbacks_.after_round);
    if (!once) return false;
    if (!is_told) {
      const Window repeated = {.record = whole.record, .is_last = whole.is_last};
      std::optional<TileResult> replayed =
          engine_->orbits()->replay(orbit_plan_, subset, once->final_states, length,
                                    log_stretchings, repeated, callbacks_.after_round);
      if (!replayed) return false;
      count_settling(orbits, &*replayed);
      std::vector<std::size_t> all(positions.size());
      std::iota(all.begin(), all.end(), std::size_t{0});
      adopt_verdicts(study_, all, *replayed, &*once);
      once->final_states = std::move(replayed->final_states);
    }
    put_subset(study_, *once, positions, &result_);
    for (const std::size_t position : positions) {
      has_stopped_[position] = is_orbit_[position] = 1;
    }
    return true;
  }

  // The periods before each orbit's state belong to those after which its point has settled.
  void count_settling(const std::vector<FoundOrbit>& orbits, TileResult* recorded) const {
    const auto settled = study_.selection.output_of(OutputRole::settled);
    if (!settled) return;
    const std::span<double> numbers = recorded->output_table()[*settled];
    for (std::size_t i = 0; i < orbits.size(); ++i) {
      numbers[i] += static_cast<double>(orbits[i].settled);
    }
  }

  // The points that are not on a known orbit run to the end of the study's own window.
  bool record_the_rest() {
    if (open_.empty()) return true;
    Window rest = windows_.front();
    if (rest.is_early) callbacks_.on_work(-saved_by(rest, tile_.points));
    rest.before = settled_;
    rest.settle -= settled_;
    const Tile subset = subset_of(plan_, tile_, open_, rest.settle + rest.record);
    const std::optional<TileResult> recorded =
        engine_->compute(plan_, subset, states_, rest, callbacks_.after_round);
    if (!recorded) return false;
    put_subset(study_, *recorded, open_, &result_);
    return true;
  }

  // What the study's own window would take more than this one.
  double saved_by(const Window& window, const PointList& points) const {
    const Integrate& own = study_.integrate;
    const auto periods =
        static_cast<double>(own.settle + own.record - window.settle - window.record);
    double steps = 0.0;
    for (const std::size_t point : points) steps += static_cast<double>(plan_.steps_of(point));
    return steps * periods;
  }

  // Those that end with an early window. open: positions in the tile of the points of `last`, of
  // which those at `undecided` go on.
  void mark_stopped(const std::vector<std::size_t>& open, const TileResult& last,
                    const std::vector<std::size_t>& undecided) {
    for (std::size_t i = 0; i < open.size(); ++i) {
      const bool goes_on = std::ranges::binary_search(undecided, i);
      if (last.status[i] == STATUS_ok && !goes_on) has_stopped_[open[i]] = 1;
    }
  }

  // The points whose verdict is undecided go on into longer windows, as a subset of the tile.
  bool extend() {
    std::vector<std::size_t> open(tile_.points.size());  // positions in the tile
    std::iota(open.begin(), open.end(), std::size_t{0});
    std::optional<TileResult> longer;  // of the points in `open`, once they have gone on
    for (std::size_t i = 1; i < windows_.size(); ++i) {
      const TileResult& last = longer ? *longer : result_;
      const std::vector<std::size_t> undecided = undecided_positions(study_, last);
      if (windows_[i - 1].is_early) mark_stopped(open, last, undecided);
      if (undecided.empty()) break;
      const std::vector<double> states = end_states(last, undecided);
      for (std::size_t j = 0; j < undecided.size(); ++j) open[j] = open[undecided[j]];
      open.resize(undecided.size());
      const Tile subset = subset_of(plan_, tile_, open, windows_[i].settle + windows_[i].record);
      callbacks_.on_work(subset.work);
      longer = engine_->compute(plan_, subset, states, windows_[i], callbacks_.after_round);
      if (!longer) return false;
      if (windows_[i - 1].is_early) {
        put_subset(study_, *longer, open, &result_);
      } else {
        adopt_longer_window(study_, open, *longer, &result_);
      }
    }
    return true;
  }

  const Plan& plan_;
  const Study& study_;
  const Plan orbit_plan_;  // with the steps of motions on their orbits
  const Tile& tile_;
  Engine* engine_;
  const TileCallbacks& callbacks_;
  const std::vector<Window> windows_;
  TileResult result_;
  std::vector<std::uint8_t> has_stopped_;  // [point of the tile] on a periodic orbit, or cycle
  std::vector<std::uint8_t> is_orbit_;     // [point of the tile] that the search has found
  std::vector<std::size_t> open_;          // positions
  std::vector<double> states_;             // [open point][state]
  std::size_t settled_ = 0;                // periods integrated before these states
};

}  // namespace

std::optional<TileResult> run_tile(const Plan& plan, const Tile& tile,
                                   const std::vector<double>& initial, Engine* engine,
                                   const TileCallbacks& callbacks) {
  return TileRun(plan, tile, engine, callbacks).run(initial);
}

}  // namespace gearsweep
