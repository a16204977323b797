#include "borders/orbit_way.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "orbits/period_map.hpp"

namespace gearsweep {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::RowVectorXd;
using Eigen::VectorXd;

constexpr double kNearMark = 0.06;   // of a period: how far from the mark a turn is looked for
constexpr double kTurnFound = 1e-8;  // of the bracket: a turn is flat
constexpr double kNoStep = 1e-12;    // of a period
constexpr double kFlat = 1e-12;      // of the swing: a level that does not move
constexpr int kMaxInterpolations = 12;

}  // namespace

OrbitWay::OrbitWay(const Model& model, const ModelSetting& setting, std::size_t steps,
                   const std::atomic<bool>* stop)
    : model_(&model),
      grid_(make_phase_grid(model, setting, steps)),
      point_(model.prepare(setting)),
      stop_(stop),
      duration_(point_->period()),
      width_(model.phase_coefs.size()),
      row_at_(model.phase_rows(setting)),
      contacts_(model, *point_),
      held_(model, point_.get()),
      step_(&held_) {}

bool OrbitWay::walk(std::size_t halves, HeldMotion* motion, const EachStep& each_step) {
  for (std::size_t done = 0; done < halves; done += 2) {
    if (stop_ != nullptr && *stop_) throw SearchStopped();
    const double last = halves - done == 1 ? 0.5 : 1.0;
    const double* coefs = grid_.coefs.data();
    double phase = 0.0;
    for (std::size_t segment = 0; segment < grid_.segment_steps.size(); ++segment) {
      const double length = grid_.segment_fractions[segment];
      const std::uint32_t count = grid_.segment_steps[segment];
      const double inside = phase + 0.5 * length * count;
      held_.begin(coefs, length * duration_, motion->state.data());
      for (std::uint32_t i = 0; i < count; ++i) {
        const double begin = phase + length * i, left = last - begin;
        if (left < kNoStep) return true;
        const bool is_whole = left > length - kNoStep;
        const StepMoments moments = {&row_at_,
                                     width_,
                                     begin,
                                     is_whole ? length : left,
                                     inside,
                                     duration_,
                                     is_whole ? coefs : nullptr};
        if (!each_step(moments, 0.5 * static_cast<double>(done) + begin)) return false;
        coefs += 2 * width_;
      }
      phase += length * count;
      coefs += width_;  // the next segment has its own one-sided row at the break phase
    }
    const VectorXd& state = motion->state;
    if (!model_->is_within_limits({state.data(), static_cast<std::size_t>(state.size())})) {
      return false;
    }
  }
  return true;
}

bool OrbitWay::is_near(const Walk& walk, double time) const {
  const double apart = time - (*walk.mark)->moment;
  return std::fabs(std::remainder(apart, static_cast<double>(walk.periods))) < kNearMark;
}

bool OrbitWay::take_step(const StepMoments& moments, double begin, HeldMotion* motion, Walk* walk) {
  if (!walk->mark->has_value() || !is_near(*walk, begin)) {
    step_.take(moments, motion);
    return motion->state.allFinite();
  }
  const std::size_t limit = (*walk->mark)->limit.index;
  std::vector<double> row;
  const auto note = [&](double from, double to, const HeldMotion& before,
                        const HeldMotion& behind) {
    const double first = level(limit, moments.at(from, &row), before.state);
    const double last = level(limit, moments.at(to, &row), behind.state);
    walk->parts.push_back({moments, begin, from, to, before, first, last, held_});
  };
  if (held_.is_contact(limit)) {
    step_.take(moments, motion, note);
    return motion->state.allFinite();
  }
  const HeldMotion before = *motion;
  held_.hold_contacts(moments.at(0.0, &row), motion->state.data());
  step_.carry(moments, 0.0, 1.0, motion);
  note(0.0, 1.0, before, *motion);
  // It must be back on its side where the next step is cut again.
  const double sign = (*walk->mark)->limit.is_from_below ? 1.0 : -1.0;
  const bool is_last = !is_near(*walk, begin + moments.length);
  return motion->state.allFinite() && !(is_last && sign * walk->parts.back().level_behind > 0.0);
}

std::optional<OrbitWay::End> OrbitWay::go(HeldMotion motion, std::size_t halves,
                                          const std::optional<GrazeMark>& mark) {
  Walk way{halves / 2, &mark, {}};
  if (mark && !held_.is_contact(mark->limit.index)) {
    // Where it begins beyond the surface its sides are not those of the motion.
    const double sign = mark->limit.is_from_below ? 1.0 : -1.0;
    if (sign * level(mark->limit.index, grid_.coefs.data(), motion.state) > 0.0) {
      return std::nullopt;
    }
  }
  const auto take = [&](HeldMotion* at, double from) {
    return [this, at, from, &way](const StepMoments& moments, double begin) {
      return take_step(moments, from + begin, at, &way);
    };
  };
  if (!walk(halves, &motion, take(&motion, 0.0))) return std::nullopt;
  if (!mark) return End{std::move(motion), std::nullopt};
  // A step more: a turn at the end has something behind it.
  HeldMotion behind = motion;
  bool is_first = true;
  const EachStep one = take(&behind, static_cast<double>(way.periods));
  walk(2, &behind, [&](const StepMoments& moments, double begin) {
    return std::exchange(is_first, false) && one(moments, begin);
  });
  std::optional<LevelTurn> turn = turn_of(&way);
  if (!turn) return std::nullopt;
  return End{std::move(motion), std::move(turn)};
}

std::optional<LevelTurn> OrbitWay::turn_of(Walk* walk) {
  const double sign = (*walk->mark)->limit.is_from_below ? 1.0 : -1.0;
  const double around = static_cast<double>(walk->periods);
  std::optional<std::size_t> best;
  double nearest = kNearMark;
  for (std::size_t i = 0; i + 1 < walk->parts.size(); ++i) {
    const Part &early = walk->parts[i], &late = walk->parts[i + 1];
    const double time = early.time_at(early.to);
    if (std::fabs(late.time_at(late.from) - time) > kNoStep * around) continue;  // no neighbours
    const double before = sign * early.level_before, here = sign * early.level_behind,
                 behind = sign * late.level_behind;
    if (!(here > before && here >= behind)) continue;
    const double apart = std::fabs(std::remainder(time - (*walk->mark)->moment, around));
    if (apart >= nearest) continue;
    nearest = apart;
    best = i;
  }
  if (!best) return std::nullopt;
  return refine(&walk->parts[*best], &walk->parts[*best + 1], *walk);
}

HeldMotion OrbitWay::at(Part* part, double share, bool has_tangents) {
  HeldMotion out = part->before;
  if (!has_tangents) out.tangents.resize(out.state.size(), 0);
  part->field.hold_again();
  HeldStep(&part->field).carry(part->moments, part->from, share, &out);
  return out;
}

// By successive parabolic interpolation.
LevelTurn OrbitWay::refine(Part* early, Part* late, const Walk& walk) {
  const GrazedLimit& limit = (*walk.mark)->limit;
  const double sign = limit.is_from_below ? 1.0 : -1.0;
  struct Place {
    double time, value;
  };
  const double middle = early->time_at(early->to);
  const auto part_at = [&](double time) { return time <= middle ? early : late; };
  const auto share_of = [](const Part& part, double time) {
    return std::clamp((time - part.begin) / part.moments.length, part.from, part.to);
  };
  std::vector<double> row;
  const auto look = [&](double time) {
    Part* const part = part_at(time);
    const double share = share_of(*part, time);
    const HeldMotion motion = at(part, share, false);
    return sign * level(limit.index, part->moments.at(share, &row), motion.state);
  };
  Place low = {early->time_at(early->from), sign * early->level_before};
  Place top = {middle, sign * early->level_behind};
  Place high = {late->time_at(late->to), sign * late->level_behind};
  for (int i = 0; i < kMaxInterpolations; ++i) {
    const double before = top.time - low.time, behind = high.time - top.time;
    const double fall = before * (top.value - high.value), rise = behind * (top.value - low.value);
    const double way = 0.5 * (behind * rise - before * fall) / (fall + rise);
    const double time = top.time + way;
    if (!(low.time < time && time < high.time) || std::fabs(way) < kTurnFound * (before + behind)) {
      break;
    }
    const Place next = {time, look(time)};
    if (next.value > top.value) {
      (way > 0.0 ? low : high) = top;
      top = next;
    } else {
      (way > 0.0 ? high : low) = next;
    }
  }
  Part* const part = part_at(top.time);
  const double share = share_of(*part, top.time);
  const HeldMotion motion = at(part, share, true);
  const double* const coefs = part->moments.at(share, &row);
  LevelTurn out;
  out.level = level(limit.index, coefs, motion.state);
  out.gradient = level_gradient(limit.index, coefs, motion.state) * motion.tangents;
  out.moment = std::fmod(top.time, static_cast<double>(walk.periods));
  return out;
}

double OrbitWay::level(std::size_t limit, const double* coefs, const VectorXd& state) {
  if (held_.is_contact(limit)) {
    return contacts_.depths(coefs, state.data())[limit - model_->surfaces.size()];
  }
  std::vector<double> all(model_->surfaces.size());
  point_->of_surfaces(SurfaceValue::level, coefs, state.data(), all.data());
  return all[limit];
}

RowVectorXd OrbitWay::level_gradient(std::size_t limit, const double* coefs,
                                     const VectorXd& state) {
  if (held_.is_contact(limit)) {
    const std::size_t flank = limit - model_->surfaces.size();
    return model_->contact_limits()[flank].flank *
           contacts_.gradient_at(coefs, state.data(), flank);
  }
  const auto n = static_cast<std::size_t>(state.size());
  std::vector<double> all(model_->surfaces.size() * n);
  point_->of_surfaces(SurfaceValue::level_gradient, coefs, state.data(), all.data());
  return RowVectorXd::Map(all.data() + limit * n, state.size());
}

std::vector<OrbitWay::Seen> OrbitWay::turns(const VectorXd& state, std::size_t periods) {
  struct Look {
    double time;
    std::vector<double> levels;
    std::vector<bool> is_reset;  // [surface] in the step that ends or begins here
  };
  const std::size_t surfaces = model_->surfaces.size(), all = limits();
  std::vector<Look> looks;
  HeldMotion motion{state, MatrixXd(state.size(), 0)};
  std::vector<double> row;
  const auto look = [&](double time, const double* coefs, const VectorXd& x) {
    Look out{time, std::vector<double>(all), std::vector<bool>(surfaces)};
    for (std::size_t i = 0; i < all; ++i) out.levels[i] = level(i, coefs, x);
    looks.push_back(std::move(out));
  };
  const bool is_whole = walk(2 * periods, &motion, [&](const StepMoments& moments, double begin) {
    if (looks.empty()) look(0.0, moments.at(0.0, &row), motion.state);
    const std::size_t first = looks.size() - 1;
    step_.take(moments, &motion,
               [&](double, double to, const HeldMotion&, const HeldMotion& behind) {
                 look(begin + to * moments.length, moments.at(to, &row), behind.state);
               });
    for (const HeldField::Met& met : held_.take_met()) {
      for (std::size_t i = first; i < looks.size(); ++i) looks[i].is_reset[met.surface] = true;
    }
    return motion.state.allFinite();
  });
  std::vector<Seen> out;
  if (!is_whole || looks.size() < 4) return out;
  // The first look is the last of the orbit.
  const std::size_t count = looks.size() - 1;
  for (std::size_t limit = 0; limit < all; ++limit) {
    if (limit < surfaces && model_->surfaces[limit].is_staircase) continue;
    const auto value = [&](std::size_t i) { return looks[i].levels[limit]; };
    double min = value(0), max = value(0);
    for (std::size_t i = 1; i <= count; ++i) {
      min = std::min(min, value(i));
      max = std::max(max, value(i));
    }
    const double swing = max - min;
    for (std::size_t i = 1; i <= count && swing > 0.0; ++i) {
      const std::size_t next = i == count ? 1 : i + 1;
      if (limit < surfaces && (looks[i].is_reset[limit] || looks[i - 1].is_reset[limit])) continue;
      for (const double sign : {1.0, -1.0}) {
        const double rise = sign * (value(i) - value(i - 1)),
                     fall = sign * (value(i) - value(next));
        if (!(rise > 0.0 && fall >= 0.0) || rise + fall < kFlat * swing) continue;
        out.push_back({{{limit, sign > 0.0}, looks[i].time}, value(i), swing});
      }
    }
  }
  return out;
}

}  // namespace gearsweep
