#include "sweep/pilot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "model/error.hpp"
#include "plan/plan.hpp"
#include "study/own_step.hpp"
#include "sweep/detail/map_errors.hpp"
#include "sweep/detail/share_bound.hpp"
#include "sweep/sweep.hpp"

namespace gearsweep {
namespace {

// A pilot run takes 1.25 to 2.5 times as long as its points at the model's own step, and to start
// its kernels half a second on two cores. It saves up to three quarters of the time at all points.
// Below so many points, or steps at the model's own step, it would not pay.
constexpr std::size_t kFewestPoints = 4096;
constexpr double kFewestSteps = 1e9;
// Points of the pilot. What a step leaves beyond the tolerance is told from these, and not all are
// periodic. Whoever asks for a tolerance asks for more.
constexpr std::size_t kMinPilot = 384, kMinPilotAsked = 768, kMaxPilot = 1024;
constexpr std::size_t kPointsPerPilotPoint = 96;
constexpr double kBeyond = 0.01;  // of the pilot's periodic points may be beyond the tolerance
// And of all points of the study, at 95 % confidence; but where all of the few points of a pilot
// keep it, that has to do.
constexpr double kBeyondOfAll = 0.03;
constexpr std::size_t kMinPeriodic = 3;  // points that a verdict can rest on
constexpr double kMaxSensitive = 0.5;    // of the points: beyond, nothing is told
constexpr double kLongest = 4.0;         // of the ladder's steps, in the model's own
// Steps on orbits for one of the run, where their exponents need shorter ones than all other maps.
constexpr std::size_t kOrbitSteps = 4;
constexpr int kRungsPerHalf = 4;     // steps of the ladder between one and half of it
constexpr std::size_t kPairs = 3;    // of runs, that tell which points are sensitive
constexpr double kFewestMore = 1.5;  // times the steps of a run, of one that judges it
// The shortest step of a pilot, in the model's own. A pilot that nobody asked for stops where the
// run with it would take an eighth of the time of all points at the model's own step, and may
// always go down to a quarter of that step.
constexpr double kShortest = 1.0 / 256.0, kShortestUnasked = 1.0 / 4.0, kUnaskedShare = 1.0 / 8.0;

// Each point of the sub-grid on its own.
Study pilot_study(const Study& study) {
  Study pilot = study;
  const std::size_t wanted =
      std::clamp(study.points() / kPointsPerPilotPoint,
                 study.integrate.is_tolerance_asked ? kMinPilotAsked : kMinPilot, kMaxPilot);
  const double share =
      std::min(1.0, static_cast<double>(wanted) / static_cast<double>(study.points()));
  for (Axis& axis : pilot.axes) {
    const double count = static_cast<double>(axis.values.size()) *
                         std::pow(share, 1.0 / static_cast<double>(pilot.axes.size()));
    axis = thin(axis, static_cast<std::size_t>(std::ceil(count)));
  }
  pilot.separate_points();
  pilot.integrate.tolerance = 0.0;
  pilot.integrate.stop = Stop::orbit;
  return pilot;
}

// The user stopped it: unwinds to choose_step().
struct Stopped {};

// The pilot at different steps, each computed once.
class PilotRuns {
 public:
  PilotRuns(const Study& study, const SweepOptions& options)
      : study_(pilot_study(study)),
        tolerances_{study.integrate.tolerance, study.integrate.exponent_tolerance},
        motion_ranges_(motion_ranges(study)) {
    if (options.on_pilot) options.on_pilot(study_.points());
    own_.devices = options.devices;
    own_.scheduler = options.scheduler;
    own_.priority = options.priority;
    own_.stop = options.stop;
  }

  std::size_t points() const { return study_.points(); }
  // The steps of a period have a limit.
  bool is_possible(double step) const {
    try {
      return Plan(with_step(step), study_.points()).total_work() > 0.0;
    } catch (const InputError&) {
      return false;
    }
  }
  // Whether each point has more steps at `fine`: a period has steps that no max_step makes fewer,
  // and a run tells nothing beside another with the same ones.
  bool differ(double coarse, double fine) const {
    const Plan longer(with_step(coarse), study_.points());
    const Plan shorter(with_step(fine), study_.points());
    std::set<std::vector<double>> seen;
    for (std::size_t point = 0; point < study_.points(); ++point) {
      if (!seen.insert(shorter.grid_key(point)).second) continue;
      const auto steps = [&](const Plan& plan) {
        return static_cast<double>(plan.phase_grid_of(point).steps);
      };
      if (steps(shorter) < kFewestMore * steps(longer)) return false;
    }
    return true;
  }
  MapErrors errors(double coarse, double fine) {
    return {run(coarse), run(fine), tolerances_, motion_ranges_};
  }
  std::size_t orbit_steps() const { return study_.integrate.orbit_steps; }
  // Of all runs from here on.
  void set_orbit_steps(std::size_t steps) {
    study_.integrate.orbit_steps = steps;
    runs_.clear();
  }

 private:
  Study with_step(double step) const {
    Study study = study_;
    study.integrate.max_step = step;
    return study;
  }

  const SweepResult& run(double step) {
    const auto known = runs_.find(step);
    if (known != runs_.end()) return known->second;
    std::optional<SweepResult> result = run_sweep(with_step(step), own_);
    if (!result) throw Stopped();
    return runs_.emplace(step, *std::move(result)).first->second;
  }

  Study study_;
  const Tolerances tolerances_;
  const std::map<std::string, double> motion_ranges_;
  SweepOptions own_;
  std::map<double, SweepResult> runs_;
};

// Why no step was found, for whoever asked for a tolerance.
struct NoStep {
  bool is_of_exponents = false;  // whether their tolerance is the one that is not kept
  double map_tolerance = 0.0;    // of the map that no step keeps; 0: no map is to blame
  std::string reason;
};

// The shortest step that is tried, as a share of the model's own.
double shortest_share(const Study& study, std::size_t pilot_points) {
  if (study.integrate.is_tolerance_asked) return kShortest;
  const double share = static_cast<double>(pilot_points) / static_cast<double>(study.points());
  return std::clamp(share / kUnaskedShare, kShortest, kShortestUnasked);
}

class StepSearch {
 public:
  StepSearch(const Study& study, const SweepOptions& options)
      : study_(study),
        runs_(study, options),
        own_step_(step_in_effect()),
        shortest_(own_step_ * shortest_share(study, runs_.points())) {}

  // Throws NoStep.
  PilotFindings run() {
    const double longest = kLongest * study_.integrate.max_step;
    ask_for_periodic_points(runs_.errors(longest, own_step_));
    if (will_do(longest, own_step_)) return findings({longest, own_step_});
    if (!may_refine_orbits()) return findings(search(longest));
    judges_exponents_ = false;
    const Found for_others = search(longest);
    judges_exponents_ = true;
    if (will_do(for_others.step, for_others.fine)) return findings(for_others);
    sensitive_ = 0.0;
    runs_.set_orbit_steps(kOrbitSteps);
    return findings(search(for_others.step));
  }

 private:
  struct Found {
    double step, fine;  // the longest that will do, and that of the run which judged it
  };

  // Not longer than `longest`. Each step is judged by one of half its length at most.
  Found search(double longest) {
    const double first = std::min(own_step_, longest / 2.0);
    const double fine = will_do(longest, first) ? first : find_reference(first);
    return {find_longest(2.0 * fine, longest, fine), fine};
  }

  MapErrors errors(double coarse, double fine) {
    const MapErrors all = runs_.errors(coarse, fine);
    return judges_exponents_ ? all : all.without_exponents();
  }

  // The study's step, or so much shorter that steps of twice the length are others at each point.
  double step_in_effect() const {
    double step = study_.integrate.max_step;
    while (runs_.is_possible(step) && !runs_.differ(2.0 * step, step)) step /= 2.0;
    return runs_.is_possible(step) ? step : study_.integrate.max_step;
  }

  // Attractors are told apart by where motions are, for which all must have the same steps.
  bool may_refine_orbits() const {
    const bool has_exponents = std::ranges::any_of(
        study_.selection.quantities, [](const Quantity& one) { return is_exponent(one); });
    return has_exponents && looks_for_orbits(study_) && study_.integrate.stop == Stop::orbit &&
           runs_.orbit_steps() == 1 && !study_.selection.census;
  }

  void ask_for_periodic_points(const MapErrors& errors) const {
    if (errors.points() >= kMinPeriodic) return;
    const std::string reason = fmt::format(
        "of the pilot's points fewer than {} arrive on a periodic orbit within integrate.settle "
        "periods (with exponents integrate.warm_up fewer), so they do not tell what a step costs; "
        "give integrate.max_step instead",
        kMinPeriodic);
    throw NoStep{.reason = reason};
  }

  // Which of the sensitive points are off is chance, and so is their number.
  double share() const {
    const double variance = sensitive_ * (1.0 - sensitive_) / static_cast<double>(points_);
    return kBeyond + sensitive_ + 2.0 * std::sqrt(variance);
  }

  // The share of the study's points, at most, where it is so many of the pilot's. A pilot that has
  // all points is no sample.
  double share_of_all(std::size_t found, std::size_t points) const {
    if (runs_.points() < study_.points()) return upper_share(found, points);
    return points == 0 ? 1.0 : static_cast<double>(found) / static_cast<double>(points);
  }

  // What the pilot's points tell of all: without those that no step brings to within the tolerance.
  bool is_supported(const MapErrors& errors) const {
    const double bound = share_of_all(errors.beyond(), errors.points());
    return bound <= std::max(kBeyondOfAll + share() - kBeyond, share_of_all(0, errors.points()));
  }

  bool will_do(double coarse, double fine) {
    const MapErrors pair = errors(coarse, fine);
    return pair.furthest(share()).is_kept() && is_supported(pair) && pair.others_agree(kBeyond);
  }

  // From `first` on down a step so short that one of twice its length will do at all points but the
  // sensitive ones. These were counted in the same pair of runs, so chance adds nothing to their
  // share.
  double find_reference(double first) {
    std::vector<MapErrors> halvings;
    if (runs_.differ(4.0 * first, 2.0 * first)) {
      halvings.push_back(errors(4.0 * first, 2.0 * first));
    }
    for (double fine = first; fine >= shortest_ && runs_.is_possible(fine); fine /= 2.0) {
      const MapErrors& last = halvings.emplace_back(errors(2.0 * fine, fine));
      if (last.furthest(kBeyond).is_kept()) return fine;
      if (halvings.size() < kPairs) continue;
      const double sensitive = MapErrors::sensitive_share(halvings);
      if (sensitive > kMaxSensitive || is_at_best(halvings)) break;
      if (!last.furthest(kBeyond + sensitive).is_kept()) continue;
      sensitive_ = sensitive;
      points_ = last.points();
      return fine;
    }
    throw no_step_keeps_it(halvings.back().furthest(kBeyond));
  }

  // Whether shorter steps do not help half of the points, as where rounding is all that is left.
  bool is_at_best(const std::vector<MapErrors>& halvings) const {
    const double excess = halvings.back().furthest(0.5).excess();
    return excess > 1.0 && excess > halvings[halvings.size() - kPairs].furthest(0.5).excess();
  }

  NoStep no_step_keeps_it(const FurthestMap& map) const {
    return {
        .is_of_exponents = map.is_exponent,
        .map_tolerance = map.tolerance,
        .reason = fmt::format("the best step leaves {:.2g}{}; ask for more than that{}, or give "
                              "integrate.max_step",
                              map.error, map.quantity.empty() ? "" : " in " + map.quantity,
                              study_.integrate.fp64 ? "" : " (fp32 has no more digits; fp64 may)")};
  }

  // The longest step of the ladder from `shortest`, which will do, to `longest`.
  double find_longest(double shortest, double longest, double fine) {
    const auto step = [&](int rung) { return shortest * std::exp2(rung / double{kRungsPerHalf}); };
    int good = 0;
    int bad = static_cast<int>(std::lround(std::log2(longest / shortest) * kRungsPerHalf));
    if (will_do(step(bad), fine)) return step(bad);
    while (bad - good > 1) {
      const int middle = (good + bad) / 2;
      (will_do(step(middle), fine) ? good : bad) = middle;
    }
    return step(good);
  }

  PilotFindings findings(const Found& found) {
    const MapErrors errors = runs_.errors(found.step, found.fine);
    const std::size_t points = errors.points();
    // Two runs agree by chance at some of the points that land elsewhere, so more may than are
    // found to; but none at which this step makes no difference.
    const auto elsewhere =
        static_cast<std::size_t>(std::lround(sensitive_ * static_cast<double>(points)));
    return {.step = {found.step, runs_.orbit_steps()},
            .error = errors.largest(share()),
            .kept = 1.0 - share_of_all(errors.beyond(), points),
            .sensitive = sensitive_,
            .max_sensitive = share_of_all(std::max(elsewhere, errors.beyond_in_any()), points),
            .points = points,
            .errors = errors.of_quantities(share())};
  }

  const Study& study_;
  PilotRuns runs_;
  const double own_step_;
  const double shortest_;
  bool judges_exponents_ = true;
  double sensitive_ = 0.0;  // share of the periodic points
  std::size_t points_ = 1;  // that it was counted among
};

bool wants_pilot(const Study& study) {
  if (study.integrate.tolerance == 0.0) return false;
  if (study.integrate.is_tolerance_asked) return true;
  const std::size_t all = study.trajectories();
  if (all < kFewestPoints || study.integrate.engine != EngineKind::opencl) return false;
  const Study pilot = pilot_study(study);
  const auto share = static_cast<double>(pilot.points()) / static_cast<double>(all);
  return Plan(pilot, pilot.points()).total_work() / share >= kFewestSteps;
}

// Which of the study's demands is not met: one that it makes, where a map is to blame that one's.
std::string asked_of(const Integrate& integrate, const NoStep& none) {
  const bool is_of_one_map = none.map_tolerance > 0.0;
  const bool is_of_exponents =
      is_of_one_map ? none.is_of_exponents && integrate.exponent_tolerance != integrate.tolerance
                    : !integrate.is_map_tolerance_given;
  if (is_of_exponents) {
    return fmt::format("integrate.exponent_tolerance = {}", integrate.exponent_tolerance);
  }
  return fmt::format(
      "integrate.tolerance = {}{}", integrate.tolerance,
      integrate.is_map_tolerance_given ? "" : ", the default beside exponent_tolerance");
}

void tell_of_own_step(const Study& study, const NoStep& none, const SweepOptions& options) {
  if (!options.warn) return;
  options.warn(fmt::format("the pilot run found no step, so that of the model, {}, is taken: {}",
                           study.integrate.max_step, none.reason));
}

}  // namespace

Axis thin(const Axis& axis, std::size_t count) {
  const std::size_t all = axis.values.size();
  if (all <= count) return axis;
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < count; ++i) {
    places.push_back(count == 1 ? 0 : i * (all - 1) / (count - 1));
  }
  return axis.at(places);
}

std::optional<SteppedStudy> choose_step(const Study& study, const SweepOptions& options) {
  if (!wants_pilot(study)) return SteppedStudy{study, std::nullopt};
  try {
    SteppedStudy stepped{study, StepSearch(study, options).run()};
    stepped.pilot->step.give_to(&stepped.study);
    return stepped;
  } catch (const Stopped&) {
    return std::nullopt;
  } catch (const NoStep& none) {
    if (!study.integrate.is_tolerance_asked) {
      tell_of_own_step(study, none, options);
      return SteppedStudy{study, std::nullopt};
    }
    throw InputError(fmt::format("{}: {}", asked_of(study.integrate, none), none.reason));
  }
}

}  // namespace gearsweep
