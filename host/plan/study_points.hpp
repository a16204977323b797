// The points of a study: the grid of its axes, as often as it has trajectories of each point.
#pragma once

#include <memory>
#include <vector>

#include "plan/point_source.hpp"
#include "study/study.hpp"

namespace gearsweep {

// Where a point of a study that goes on from no other one starts, before its ensemble and its axes
// of initial states: a state of the whole model. setting: the point's.
std::vector<double> start_of_policy(const Study& study, const ModelSetting& setting);

// Point (ix, iy) of the axes, of which x has nx values, has index iy * nx + ix. With an ensemble or
// uncertain parameters, trajectory m of point p is point m * study.points() + p; the first one has
// the nominal parameters. Where the study's policy goes on from a neighbour, each place along its
// axis is a stage; where draws start from the nominal motions, these are the first one.
class StudyPoints final : public PointSource {
 public:
  explicit StudyPoints(std::shared_ptr<const Study> study);

  std::size_t size() const override { return study_->trajectories(); }
  std::string key() const override { return "the study's"; }
  const std::vector<std::size_t>& differing() const override { return differing_; }
  void set(std::size_t point, ModelSetting* setting) const override;
  std::vector<double> start(std::size_t point) const override;
  std::string name(std::size_t point) const override;
  std::size_t stages() const override { return study_->stages(); }
  std::size_t stage_size(std::size_t stage) const override;
  std::size_t point(std::size_t stage, std::size_t i) const override;
  std::optional<std::size_t> predecessor(std::size_t point) const override;
  std::size_t row() const override;

 private:
  // Gives uncertain parameters what they have in a trajectory of a point, whose axes are placed.
  void place_draw(std::size_t member, ModelSetting* setting) const;

  const std::shared_ptr<const Study> study_;
  std::vector<std::size_t> differing_;
  std::vector<std::vector<double>> offsets_;  // [trajectory of an ensemble's point][state]
};

}  // namespace gearsweep
