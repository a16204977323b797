// The way of a motion on the host, step by step, with the levels of the limits that it comes near:
// where they turn, and how that depends on the start. Where a level turns at 0 the motion grazes
// the limit.
#pragma once

#include <Eigen/Core>
#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "borders/orbit_map.hpp"
#include "model/held_step.hpp"
#include "model/model.hpp"
#include "plan/phase_grid.hpp"

namespace gearsweep {

class OrbitWay {
 public:
  // At least `steps` steps per period. The model, a whole one, must outlive it. stop: as in
  // PeriodMap.
  OrbitWay(const Model& model, const ModelSetting& setting, std::size_t steps,
           const std::atomic<bool>* stop);

  struct End {
    HeldMotion motion;
    std::optional<LevelTurn> turn;  // its gradient by the start's tangents
  };
  // So many halves of forcing periods on from phase 0. mark: a turn that is looked for, of whole
  // periods alone; around it steps are not cut at a surface of the mark's own, so that the turn is
  // a smooth function of the start on both sides of the graze. Nothing where the motion leaves the
  // range that counts as finite, or has no such turn.
  std::optional<End> go(HeldMotion motion, std::size_t halves,
                        const std::optional<GrazeMark>& mark);

  // A turn, roughly, and how far its level moves along the way.
  struct Seen {
    GrazeMark mark;
    double level = 0.0, swing = 0.0;
  };
  // All turns of an orbit of so many periods, but for those where a state is reset.
  std::vector<Seen> turns(const Eigen::VectorXd& state, std::size_t periods);

 private:
  // A part of a step that is smooth, and the field on its sides.
  struct Part {
    StepMoments moments;
    double begin;  // of the step, in periods
    double from, to;
    HeldMotion before;
    double level_before, level_behind;
    HeldField field;

    double time_at(double share) const { return begin + share * moments.length; }
  };
  struct Walk {
    std::size_t periods = 0;
    const std::optional<GrazeMark>* mark = nullptr;
    std::vector<Part> parts;  // near the mark
  };
  using EachStep = std::function<bool(const StepMoments& moments, double begin)>;

  // Calls each_step for all steps of the halves, until it says false; false then.
  bool walk(std::size_t halves, HeldMotion* motion, const EachStep& each_step);
  bool take_step(const StepMoments& moments, double begin, HeldMotion* motion, Walk* walk);
  bool is_near(const Walk& walk, double time) const;
  std::optional<LevelTurn> turn_of(Walk* walk);
  LevelTurn refine(Part* early, Part* late, const Walk& walk);
  // A motion of a part, at a share of its step.
  HeldMotion at(Part* part, double share, bool has_tangents);
  std::size_t limits() const { return model_->surfaces.size() + model_->contact_limits().size(); }
  double level(std::size_t limit, const double* coefs, const Eigen::VectorXd& state);
  Eigen::RowVectorXd level_gradient(std::size_t limit, const double* coefs,
                                    const Eigen::VectorXd& state);

  const Model* model_;
  PhaseGrid grid_;
  std::unique_ptr<PreparedPoint> point_;
  const std::atomic<bool>* stop_;
  double duration_;
  std::size_t width_;
  Model::PhaseRow row_at_;
  ContactField contacts_;
  HeldField held_;
  HeldStep step_;
};

}  // namespace gearsweep
