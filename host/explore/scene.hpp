// What a page of the explorer shows: a study whose two axes reach beyond the first view, and the
// places of its tiles and cells on them.
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "explore/state_ranges.hpp"
#include "point/place.hpp"
#include "study/found_step.hpp"
#include "study/study.hpp"

namespace gearsweep {

// What a page changes of the study that explore was started with.
struct SceneChanges {
  std::vector<NamedValue> sets;  // of parameters and initial states
  std::string x, y;              // what is swept instead: parameters or states; empty: as it is
};

// A point: at share k / 2^depth of either axis. Cell k is cell 2k at the next depth, the same point
// with the same bits.
struct Cell {
  static constexpr std::size_t kMaxDepth = 51;

  std::size_t depth = 0;
  std::array<std::uint64_t, 2> k = {};
};

// A square of cells. At depth d each axis has 2^d tiles; a cell's depth is 5 more.
struct TilePlace {
  static constexpr std::size_t kCells = 32;  // along either axis
  static constexpr std::size_t kPoints = kCells * kCells;
  static constexpr std::size_t kMaxDepth = Cell::kMaxDepth - 5;

  std::size_t depth = 0;
  std::array<std::uint64_t, 2> at = {};

  TilePlace parent() const { return {depth - 1, {at[0] / 2, at[1] / 2}}; }
  friend auto operator<=>(const TilePlace&, const TilePlace&) = default;
};

// Which study explore was started with, and the step that all of its scenes take; nothing: each
// scene's own.
struct ExploredStudy {
  Study study;
  std::optional<FoundStep> pilot_step;
  bool has_one_axis = false;  // the study itself: a diagram tells more of it than a map
  // Those of the study.
  std::shared_ptr<LateStateRanges> state_ranges = std::make_shared<LateStateRanges>();
};

// What a command of gearsweep takes behind --set, for the same changes of the study but its axes.
// Throws InputError for what the model does not allow.
std::vector<std::string> overrides_of(const Study& base, const std::vector<NamedValue>& sets);

class Scene {
 public:
  // base: see explorable(). Throws InputError for changes that the model does not allow.
  Scene(const ExploredStudy& base, const SceneChanges& changes);

  const SceneChanges& changes() const { return changes_; }
  // Two scenes of one base with the same key are the same. A short text of letters and digits.
  const std::string& key() const { return key_; }
  // Its axes have their ends alone.
  const Study& study() const { return study_; }
  // [axis] where the first view begins and ends, as values.
  const std::array<std::array<double, 2>, 2>& first_view() const { return first_view_; }

  double value_at(std::size_t axis, double share) const;
  double value_at(std::size_t axis, std::uint64_t k, std::size_t depth) const;
  // Below 0 and above 1 beyond the scene's axis.
  double share_of(std::size_t axis, double value) const;
  // [state] how far motions go (state_ranges()); null while that is not known.
  const std::vector<StateRange>* state_ranges() const { return state_ranges_->if_known(); }
  // [state] where a point starts that the axes leave as it is.
  std::vector<double> start() const;
  // The study with these values on its axes.
  Study at(const std::array<std::vector<double>, 2>& values) const;
  // The same with samples of all states (Selection::poincare). Without forcing they are taken at
  // the model's own section, and behind the scene's quantities are motion_class and the means of
  // all states, of motions that rest.
  Study sampled_at(const std::array<std::vector<double>, 2>& values) const;
  // The same study with nothing but those samples and `attractor`; its axes have their ends.
  Study census() const;

 private:
  SceneChanges changes_;
  std::shared_ptr<const LateStateRanges> state_ranges_;
  Study study_;
  std::string key_;
  std::array<std::array<double, 2>, 2> first_view_ = {};
  // Read when it is first asked for.
  struct Late {
    std::once_flag is_read;
    Study study;
  };
  mutable Late sampled_, census_;
};

// The study as scenes take it: two axes of one parameter or state each, points that start on their
// own and once, quantities that a point has without the others. Of a study or a draft with fewer
// axes, other parameters are swept, too; of one without such quantities, its classes and exponents
// are looked at. What was left out and added stands in its notices. Throws InputError for axes that
// stand for several parameters.
Study explorable(const Study& study);

}  // namespace gearsweep
