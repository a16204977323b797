// How a study is cut into work: points, what each starts from, and the tiles.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "plan/phase_grid.hpp"
#include "plan/point_list.hpp"
#include "plan/point_source.hpp"
#include "plan/shared_steps.hpp"
#include "study/study.hpp"

namespace gearsweep {

// The points that one launch sequence computes; those that share a phase grid stand together, and
// grids with as many steps.
struct Tile {
  PointList points;
  std::vector<std::size_t> grid_starts;  // position in `points` where each phase grid begins
  double work = 0.0;                     // integration steps in all
};

// Tiles of one stage do not depend on each other; a stage starts from the final states of the one
// before it (where points go on from a neighbour; otherwise there is one stage).
struct Stage {
  std::vector<Tile> tiles;
};

class Plan {
 public:
  // The points of the study's axes (StudyPoints). Throws InputError when a point's setting is wrong
  // or a period would need too many steps.
  Plan(const Study& study, std::size_t tile_points);
  // Others, computed as the study says. They differ in its swept parameters alone, each of which
  // lies between the smallest and the largest value that the study's axes give it: what is left out
  // or tabulated holds there.
  Plan(std::shared_ptr<const Study> study, std::shared_ptr<const PointSource> points,
       std::size_t tile_points);
  // Cuts the same points into tiles of another size.
  void cut(std::size_t tile_points);
  // The same points with steps of twice the length, whose results tell an error, and with so many
  // steps in the place of each. They have no tiles of their own: they serve those of this plan.
  Plan with_longer_steps() const;
  Plan with_shorter_steps(std::size_t parts) const;

  const Study& study() const { return study_; }
  const PointSource& points() const { return *points_; }
  // Whether nothing of the study's model changes with the phase, at any of its points. Worked out
  // once; threads may ask.
  bool is_autonomous() const;
  std::size_t tile_points() const { return tile_points_; }  // at most, of each tile
  const std::vector<Stage>& stages() const { return stages_; }
  double total_work() const;

  ModelSetting setting_of(std::size_t point) const;
  // Steps asked of the phase grid of a point (the grid may have a few more).
  std::size_t steps_of(std::size_t point) const;
  // Integration steps of these points, each through its own number of periods.
  double steps_of(const PointList& points, const std::vector<std::uint32_t>& periods) const;
  PhaseGrid phase_grid_of(std::size_t point) const;
  // Points with the same key share a phase grid.
  std::vector<double> grid_key(std::size_t point) const;
  // The state that a point starts from when no predecessor gives one: of the study's model, which
  // may be a reduced one.
  std::vector<double> own_initial_state(std::size_t point) const;

 private:
  // Points with one phase grid, in a stage.
  struct Group {
    double steps = 0.0;  // of a period
    PointList points;
  };

  // The same points with other steps, without tiles.
  Plan(const Plan& other, std::size_t step_length, std::size_t step_parts);

  // Throws InputError. wrong: with the setting of the point.
  [[noreturn]] void refuse(std::size_t point, const std::string& wrong) const;
  void check_breaks(std::size_t point, const ModelSetting& setting) const;
  void set_key(const ModelSetting& setting, std::vector<double>* key) const;
  SharedSteps shared_steps_of_study() const;
  std::size_t steps_at(const ModelSetting& setting) const;
  // So many that they tell the waves of the study's orders.
  double steps_for_orders(const ModelSetting& setting) const;
  std::vector<Group> groups_of(std::size_t stage) const;
  Stage stage_of(const std::vector<Group>& groups) const;

  struct Autonomy {
    std::once_flag once;
    bool is_known_to_be = false;
  };

  const std::shared_ptr<Autonomy> autonomy_ = std::make_shared<Autonomy>();
  // Copies of a plan share it: a list of points may be large.
  const std::shared_ptr<const Study> shared_;
  const Study& study_ = *shared_;
  const std::shared_ptr<const PointSource> points_;
  std::size_t tile_points_ = 0;
  SharedSteps shared_steps_;
  // A step is so many steps of the study, cut into so many parts.
  std::size_t step_length_ = 1, step_parts_ = 1;
  std::vector<std::vector<Group>> groups_;  // [stage]
  std::vector<Stage> stages_;
};

// The tiles of a plan, by number: those of the first stage first.
std::vector<const Tile*> tiles_of(const Plan& plan);

}  // namespace gearsweep
