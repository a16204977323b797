#include "borders/border_search.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <complex>
#include <memory>
#include <mutex>
#include <thread>

#include "borders/curve_distance.hpp"
#include "borders/device_orbit_map.hpp"
#include "borders/held_orbits.hpp"
#include "borders/joined_orbit_map.hpp"
#include "borders/settled_pixels.hpp"
#include "model/error.hpp"
#include "orbits/period_map.hpp"
#include "plan/passive_states.hpp"
#include "scheduler/make_engine.hpp"

namespace gearsweep {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kHalfPixel = 0.5, kOnCurve = 0.05;  // pixels
constexpr std::size_t kMaxRounds = 12;
constexpr std::size_t kMaxTries = 8;    // seeds of a border that find nothing
constexpr std::size_t kAtOnce = 8;      // threads, which mostly wait for the device
constexpr double kFarCrossing = 2.0;    // in scaled unknowns: from a pixel to a border beside it
constexpr double kBeyond = 1.5;         // pixels from the middle of an edge
constexpr int kPartsOfWay = 4;          // in which an orbit is carried from pixel to pixel
constexpr double kNearestShare = 1e-5;  // of that way: how near to its end
constexpr double kSmallAngle = 0.02;    // of a pair: a resonance, or none at all
constexpr double kNearReach = 0.5;      // sizes of the states, in one of them

// A pair of pixels, seen from the one whose orbit is known.
struct Seed {
  std::size_t border = 0, edge = 0;
  std::size_t from = 0, to = 0;  // pixels
};

class BorderSearch {
 public:
  BorderSearch(const Study& study, const BorderRequest& request, const SweepOptions& options)
      : request_(request), pixels_(request.pixels), stop_(options.stop) {
    prepare(study);
    engine_ = make_engine(
        *settling_, options.devices.empty() ? std::nullopt : std::optional(options.devices.front()),
        options.scheduler.get());
    if (engine_->orbits() == nullptr) {
      throw InputError(
          "curves take an engine that looks for orbits: integrate.engine = \"opencl\"");
    }
    device_ = std::make_unique<DeviceOrbitMap>(following_, engine_.get(), stop_);
    joined_ = std::make_unique<JoinedOrbitMap>(device_.get());
    settled_ = std::make_unique<SettledPixels>(settling_, plane_, pixels_, engine_.get(),
                                               device_.get(), stop_);
  }

  BorderFindings find() {
    for (MapBorder& border : find_map_borders(pixels_, request_.min_edges)) {
      const std::size_t edges = border.edges.size();
      borders_.push_back(
          {std::move(border), std::vector<EdgeReason>(edges, EdgeReason::unsettled)});
    }
    is_tried_.resize(borders_.size());
    tries_.resize(borders_.size());
    for (std::size_t i = 0; i < borders_.size(); ++i) {
      is_tried_[i].resize(borders_[i].reasons.size());
    }
    for (std::size_t round = 0; round < kMaxRounds; ++round) {
      const std::vector<Seed> seeds = choose_seeds();
      if (seeds.empty()) break;
      grow(seeds);
      tell(fmt::format("round {}: {} curves, {} of {} pairs of pixels explained", round + 1,
                       curves_.size(), explained(), edges()));
    }
    explain_rest();
    BorderFindings out;
    out.study = *following_;
    out.steps = following_->integrate.steps_per_period;
    out.curves = std::move(curves_);
    out.borders = std::move(borders_);
    out.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
    return out;
  }

 private:
  void prepare(const Study& study) {
    Study base = study;
    if (base.axes.size() != 2) throw InputError("curves take a map of two axes");
    for (const Axis& axis : base.axes) {
      if (axis.is_list || !axis.columns.empty() || axis.is_state) {
        throw InputError(
            fmt::format("curves take axes of one parameter each; '{}' is none", axis.name));
      }
    }
    base.separate_points();
    base = without_passive_states(base);
    base.selection =
        select_quantities(*base.model, {"poincare"}, {base.model->states.front().name});
    base.integrate.record = 1;
    base.integrate.tolerance = base.integrate.exponent_tolerance = 0.0;
    plane_ = {base.model, base.setting, {}, {}, {}};
    Study finer = base;
    for (std::size_t i = 0; i < 2; ++i) {
      plane_.parameters[i] = base.axes[i].index;
      plane_.from[i] = base.axes[i].values.front();
      plane_.to[i] = base.axes[i].values.back();
      // Curves and differences reach a little beyond the window.
      const ParameterInfo& info = base.model->parameters[base.axes[i].index];
      const double margin = 0.1 * plane_.range(i);
      for (Study* each : {&base, &finer}) {
        each->axes[i].values = {std::max(plane_.from[i] - margin, info.min),
                                std::min(plane_.to[i] + margin, info.max)};
      }
    }
    settling_ = std::make_shared<const Study>(std::move(base));
    // What Newton's method holds is smooth to the order of the steps' error.
    finer.integrate.steps_per_period =
        request_.steps > 0 ? request_.steps
                           : std::max(kBorderSteps, finer.integrate.steps_per_period);
    following_ = std::make_shared<const Study>(std::move(finer));
    plane_.model = following_->model;
  }

  void tell(const std::string& line) const {
    if (!request_.tell) return;
    const std::chrono::duration<double> past = std::chrono::steady_clock::now() - begin_;
    request_.tell(fmt::format("{:.1f} s: {}", past.count(), line));
  }

  std::size_t explained() const {
    std::size_t out = 0;
    for (const ExplainedBorder& border : borders_) out += border.count(EdgeReason::curve);
    return out;
  }
  std::size_t edges() const {
    std::size_t out = 0;
    for (const ExplainedBorder& border : borders_) out += border.reasons.size();
    return out;
  }

  // Of each border that has enough edges left one of them, in the middle of a stretch.
  std::vector<Seed> choose_seeds() {
    std::vector<Seed> seeds;
    for (std::size_t b = 0; b < borders_.size(); ++b) {
      const ExplainedBorder& border = borders_[b];
      std::vector<std::size_t> open;
      for (std::size_t i = 0; i < border.reasons.size(); ++i) {
        if (border.reasons[i] != EdgeReason::curve && !is_tried_[b][i]) open.push_back(i);
      }
      if (open.size() < request_.min_edges || tries_[b] >= kMaxTries) continue;
      const std::size_t edge = open[open.size() / 2];
      is_tried_[b][edge] = true;
      ++tries_[b];
      auto [first, second] = border.border.edges[edge].pixels;
      // The shorter orbit first: it is the one that a longer one is born of.
      if (pixels_.label(first) == 0 ||
          (pixels_.label(second) != 0 && pixels_.label(second) < pixels_.label(first))) {
        std::swap(first, second);
      }
      seeds.push_back({b, edge, first, second});
    }
    return seeds;
  }

  void grow(const std::vector<Seed>& seeds) {
    std::vector<std::size_t> pixels;
    for (const Seed& seed : seeds) {
      pixels.push_back(seed.from);
      pixels.push_back(seed.to);
    }
    settled_->settle(pixels);
    std::size_t next = 0;
    std::mutex mutex;
    std::exception_ptr failure;
    const auto work = [&] {
      const JoinedOrbitMap::Member member(joined_.get());
      while (true) {
        std::size_t own = 0;
        {
          const std::lock_guard lock(mutex);
          if (next >= seeds.size() || failure) return;
          own = next++;
        }
        try {
          grow(seeds[own]);
        } catch (...) {
          const std::lock_guard lock(mutex);
          failure = std::current_exception();
        }
      }
    };
    {
      std::vector<std::jthread> threads;
      for (std::size_t i = 0; i < std::min(kAtOnce, seeds.size()); ++i) threads.emplace_back(work);
    }
    if (failure) std::rethrow_exception(failure);
  }

  void grow(const Seed& seed) {
    for (const bool is_back : {false, true}) {
      const std::size_t from = is_back ? seed.to : seed.from, to = is_back ? seed.from : seed.to;
      const HeldOrbit* orbit = settled_->orbit(from);
      if (orbit == nullptr) continue;
      if (grow_from(*orbit, seed, to)) return;
    }
  }

  // Whether a border between a pixel and its neighbour was found.
  bool grow_from(const HeldOrbit& orbit, const Seed& seed, std::size_t to) {
    std::optional<HeldOrbit> nearer;
    for (const BorderKind kind : {BorderKind::flip, BorderKind::fold, BorderKind::neimark_sacker}) {
      const BorderEquations equations(plane_, joined_.get(), kind, orbit.period,
                                      {orbit.sizes, {plane_.range(0), plane_.range(1)}});
      std::optional<BorderPoint> found = crossing(equations, orbit, to);
      if (!found || !is_beside(*found, seed)) {
        if (!nearer) nearer = last_stable(orbit, to);
        found = crossing(equations, *nearer, to);
      }
      if (!found || !is_beside(*found, seed)) continue;
      if (is_known(kind, orbit.period, *found)) return true;
      add(follow_border(equations, *found), *found);
      return true;
    }
    return false;
  }

  // The orbit on the way to a pixel, as near as it is found to where it ends or loses its
  // stability.
  HeldOrbit last_stable(const HeldOrbit& start, std::size_t to) {
    const PlanePlace there = pixels_.place(to);
    HeldOrbit at = start;
    VectorXd slope = VectorXd::Zero(start.state.size());  // by the share of the way
    double share = 0.0, step = 0.125;
    while (step > kNearestShare && share < 2.0) {
      HeldOrbit guess = at;
      for (std::size_t k = 0; k < 2; ++k) {
        guess.place[k] = start.place[k] + (share + step) * (there[k] - start.place[k]);
      }
      guess.state += step * slope;
      const std::optional<HeldOrbit> next =
          hold_orbits(plane_, joined_.get(), {guess}, kNearReach).front();
      if (next && next->is_stable()) {
        slope = (next->state - at.state) / step;
        at = *next;
        share += step;
      } else {
        step *= 0.5;
      }
    }
    return at;
  }

  // Where the line from the orbit's place to that of a pixel meets a border of the orbit.
  std::optional<BorderPoint> crossing(const BorderEquations& equations, const HeldOrbit& orbit,
                                      std::size_t to) const {
    BorderPoint near;
    near.place = orbit.place;
    near.state = orbit.state;
    const std::optional<std::complex<double>> critical =
        critical_multiplier(equations.kind(), orbit);
    if (!critical) return std::nullopt;
    near.angle = std::arg(*critical);
    const VectorXd guess = equations.unknowns_of(near);
    const std::optional<NullVectors> vectors = equations.null_vectors_near(guess);
    if (!vectors) return std::nullopt;
    const PlanePlace there = pixels_.place(to);
    VectorXd across = VectorXd::Zero(guess.size());
    across[guess.size() - 2] = (there[1] - orbit.place[1]) / plane_.range(1);
    across[guess.size() - 1] = -(there[0] - orbit.place[0]) / plane_.range(0);
    std::optional<BorderPoint> found =
        equations.correct(guess, across.normalized(), *vectors, kFarCrossing);
    if (!found || !found->is_of_stable_motion()) return std::nullopt;
    const bool is_pair = equations.kind() == BorderKind::neimark_sacker;
    if (is_pair && std::abs(std::sin(found->angle)) < kSmallAngle) return std::nullopt;
    return found;
  }

  // The multiplier of the orbit that would make the bifurcation; nothing where none is of its kind.
  std::optional<std::complex<double>> critical_multiplier(BorderKind kind,
                                                          const HeldOrbit& orbit) const {
    std::optional<std::complex<double>> out;
    for (const std::complex<double>& m : orbit.multipliers) {
      const bool fits = kind == BorderKind::neimark_sacker ? m.imag() > 0.0
                        : kind == BorderKind::fold         ? m.imag() == 0.0 && m.real() > 0.0
                                                           : m.imag() == 0.0 && m.real() < 0.0;
      if (fits && (!out || std::abs(m) > std::abs(*out))) out = m;
    }
    return out;
  }

  bool is_beside(const BorderPoint& point, const Seed& seed) const {
    const PixelPlace at = pixel_place(pixels_, point.place);
    const PixelPlace middle = middle_of(pixels_, borders_[seed.border].border.edges[seed.edge]);
    return std::hypot(at[0] - middle[0], at[1] - middle[1]) <= kBeyond;
  }

  bool is_known(BorderKind kind, std::size_t period, const BorderPoint& point) {
    const PixelPlace at = pixel_place(pixels_, point.place);
    const std::lock_guard lock(curves_mutex_);
    return std::ranges::any_of(curves_, [&](const BorderCurve& curve) {
      return curve.kind == kind && curve.period == period &&
             distance_to(pixels_, curve, at) <= kOnCurve;
    });
  }

  void add(BorderCurve curve, const BorderPoint& start) {
    if (is_known(curve.kind, curve.period, start)) return;  // another thread was faster
    const std::lock_guard lock(curves_mutex_);
    for (ExplainedBorder& border : borders_) {
      if (!may_explain(curve, border.border)) continue;
      for (std::size_t i = 0; i < border.reasons.size(); ++i) {
        if (border.reasons[i] == EdgeReason::curve) continue;
        const PixelPlace middle = middle_of(pixels_, border.border.edges[i]);
        if (distance_to(pixels_, curve, middle, true) <= kHalfPixel)
          border.reasons[i] = EdgeReason::curve;
      }
    }
    curves_.push_back(std::move(curve));
  }

  // Whether an orbit of the border's bifurcates on the curve, or is born there.
  static bool may_explain(const BorderCurve& curve, const MapBorder& border) {
    const int period = static_cast<int>(curve.period);
    return std::ranges::any_of(border.labels, [&](int label) {
      return label == period || (curve.kind == BorderKind::flip && label == 2 * period);
    });
  }

  // Where no curve passes: whether an orbit of the two goes on beyond the other pixel.
  void explain_rest() {
    struct Way {
      EdgeReason* reason;
      HeldOrbit at;
      PlanePlace step;
      bool is_back;
    };
    std::vector<std::size_t> pixels;
    for (ExplainedBorder& border : borders_) {
      for (std::size_t i = 0; i < border.reasons.size(); ++i) {
        if (border.reasons[i] == EdgeReason::curve) continue;
        for (const std::size_t pixel : border.border.edges[i].pixels) pixels.push_back(pixel);
      }
    }
    tell(fmt::format("{} pairs of pixels without a curve are looked at", pixels.size() / 2));
    settled_->settle(pixels);
    std::vector<Way> ways;
    for (ExplainedBorder& border : borders_) {
      for (std::size_t i = 0; i < border.reasons.size(); ++i) {
        if (border.reasons[i] == EdgeReason::curve) continue;
        const auto [a, b] = border.border.edges[i].pixels;
        for (const bool is_back : {false, true}) {
          const HeldOrbit* orbit = settled_->orbit(is_back ? b : a);
          if (orbit == nullptr) continue;
          const PlanePlace here = pixels_.place(is_back ? b : a),
                           there = pixels_.place(is_back ? a : b);
          border.reasons[i] = EdgeReason::lost;
          PlanePlace step{};
          for (std::size_t k = 0; k < 2; ++k) step[k] = (there[k] - here[k]) / kPartsOfWay;
          ways.push_back({&border.reasons[i], *orbit, step, is_back});
        }
      }
    }
    for (int part = 0; part < 2 * kPartsOfWay && !ways.empty(); ++part) {
      std::vector<HeldOrbit> guesses;
      for (const Way& way : ways) {
        HeldOrbit guess = way.at;
        for (std::size_t k = 0; k < 2; ++k) guess.place[k] += way.step[k];
        guesses.push_back(std::move(guess));
      }
      const auto found = hold_orbits(plane_, device_.get(), guesses, kNearReach);
      std::vector<Way> left;
      for (std::size_t i = 0; i < ways.size(); ++i) {
        if (!found[i] || !found[i]->is_stable()) continue;
        left.push_back(ways[i]);
        left.back().at = *found[i];
      }
      ways = std::move(left);
    }
    for (const Way& way : ways) *way.reason = EdgeReason::basin;
  }

  const std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  const BorderRequest& request_;
  const PeriodPixels& pixels_;
  const std::atomic<bool>* const stop_;
  ParameterPlane plane_;
  std::shared_ptr<const Study> settling_, following_;
  std::unique_ptr<Engine> engine_;
  std::unique_ptr<DeviceOrbitMap> device_;
  std::unique_ptr<JoinedOrbitMap> joined_;
  std::unique_ptr<SettledPixels> settled_;
  std::vector<ExplainedBorder> borders_;
  std::vector<std::vector<bool>> is_tried_;  // [border][edge]
  std::vector<std::size_t> tries_;           // [border]
  std::mutex curves_mutex_;
  std::vector<BorderCurve> curves_;
};

}  // namespace

std::string describe(EdgeReason reason) {
  switch (reason) {
    case EdgeReason::curve:
      return "a curve passes between them";
    case EdgeReason::basin:
      return "a change of basin";
    case EdgeReason::lost:
      return "an orbit is lost, and no curve was found";
    case EdgeReason::unsettled:
      break;
  }
  return "neither motion was found again";
}

std::size_t ExplainedBorder::count(EdgeReason reason) const {
  return static_cast<std::size_t>(std::ranges::count(reasons, reason));
}

std::optional<BorderFindings> find_borders(const Study& study, const BorderRequest& request,
                                           const SweepOptions& options) {
  try {
    return BorderSearch(study, request, options).find();
  } catch (const SearchStopped&) {
    return std::nullopt;
  }
}

}  // namespace gearsweep
