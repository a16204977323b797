#include "borders/border_search.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <mutex>
#include <thread>

#include "borders/crossing.hpp"
#include "borders/curve_distance.hpp"
#include "borders/device_orbit_map.hpp"
#include "borders/joined_orbit_map.hpp"
#include "borders/settled_pixels.hpp"
#include "model/error.hpp"
#include "orbits/period_map.hpp"
#include "scheduler/make_engine.hpp"

namespace gearsweep {
namespace {

constexpr double kHalfPixel = 0.5, kOnCurve = 0.05;  // pixels
constexpr std::size_t kMinOpen = 3;    // pairs of a border without a reason: worth a search
constexpr double kNearlyAll = 0.9;     // points of a curve that lie on others: it is one of them
constexpr std::size_t kMinPoints = 4;  // of a curve
constexpr std::size_t kMaxRounds = 12;
constexpr std::size_t kMaxTries = 8;  // seeds of a border that find nothing
constexpr std::size_t kAtOnce = 8;    // threads, which mostly wait for the device

// A pair of pixels, seen from the one whose orbit is known.
struct Seed {
  std::size_t border = 0, edge = 0;
  std::size_t from = 0, to = 0;  // pixels
};

class BorderSearch {
 public:
  BorderSearch(const Study& study, const BorderRequest& request, const SweepOptions& options)
      : request_(request),
        pixels_(request.pixels),
        stop_(options.stop),
        setting_(make_border_setting(study, request.steps)) {
    engine_ =
        make_engine(*setting_.settling,
                    options.devices.empty() ? std::nullopt : std::optional(options.devices.front()),
                    options.scheduler.get());
    if (engine_->orbits() == nullptr) {
      throw InputError(
          "curves take an engine that looks for orbits: integrate.engine = \"opencl\"");
    }
    device_ = std::make_unique<DeviceOrbitMap>(setting_.following, engine_.get(), stop_);
    joined_ = std::make_unique<JoinedOrbitMap>(device_.get());
    settled_ = std::make_unique<SettledPixels>(setting_.settling, plane_, pixels_, engine_.get(),
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
    tell(fmt::format("{} pairs of pixels without a curve are looked at", edges() - explained()));
    explain_without_curves(plane_, pixels_, device_.get(), settled_.get(), &borders_);
    BorderFindings out;
    out.study = *setting_.following;
    out.steps = setting_.following->integrate.steps_per_period;
    out.curves = std::move(curves_);
    out.borders = std::move(borders_);
    out.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
    return out;
  }

 private:
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
      if (open.size() < kMinOpen || tries_[b] >= kMaxTries) continue;
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
      const BorderEdge& edge = borders_[seed.border].border.edges[seed.edge];
      const std::optional<Crossing> found =
          find_crossing(plane_, pixels_, joined_.get(), *orbit, to, edge);
      if (!found) continue;
      const BorderKind kind = found->equations->kind();
      if (!is_known(kind, orbit->period, found->point)) {
        add(follow_border(*found->equations, found->point), found->point);
      }
      return;
    }
  }

  bool is_known(BorderKind kind, std::size_t period, const BorderPoint& point) {
    const std::lock_guard lock(curves_mutex_);
    return is_on_a_curve(kind, period, point);
  }
  // With the mutex held.
  bool is_on_a_curve(BorderKind kind, std::size_t period, const BorderPoint& point) const {
    const PixelPlace at = pixel_place(pixels_, point.place);
    for (std::size_t i = 0; i < curves_.size(); ++i) {
      const bool is_alike = curves_[i].kind == kind && curves_[i].period == period;
      if (is_alike && lines_[i].distance_to(at) <= kOnCurve) return true;
    }
    return false;
  }

  // Another thread may have been faster, or the curve may be one that was begun elsewhere: its
  // start or nearly all of it lies on others.
  bool is_old(const BorderCurve& curve, const BorderPoint& start) const {
    const auto is_on_one = [&](const BorderPoint& point) {
      return is_on_a_curve(curve.kind, curve.period, point);
    };
    if (is_on_one(start)) return true;
    const auto known = std::ranges::count_if(curve.points, is_on_one);
    return static_cast<double>(known) > kNearlyAll * static_cast<double>(curve.points.size());
  }

  void add(BorderCurve curve, const BorderPoint& start) {
    // Newton's method came to a place around which the equations have no curve.
    if (curve.points.size() < kMinPoints) return;
    PixelLine line(pixels_, curve);
    const std::lock_guard lock(curves_mutex_);
    if (is_old(curve, start)) return;
    for (ExplainedBorder& border : borders_) {
      if (!may_explain(curve, border.border)) continue;
      for (std::size_t i = 0; i < border.reasons.size(); ++i) {
        if (border.reasons[i] == EdgeReason::curve) continue;
        const PixelPlace middle = middle_of(pixels_, border.border.edges[i]);
        if (line.distance_to(middle, true) <= kHalfPixel) border.reasons[i] = EdgeReason::curve;
      }
    }
    curves_.push_back(std::move(curve));
    lines_.push_back(std::move(line));
  }

  // Whether an orbit of the border's bifurcates on the curve, or is born there.
  static bool may_explain(const BorderCurve& curve, const MapBorder& border) {
    const int period = static_cast<int>(curve.period);
    return std::ranges::any_of(border.labels, [&](int label) {
      return label == period || (curve.kind == BorderKind::flip && label == 2 * period);
    });
  }

  const std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  const BorderRequest& request_;
  const PeriodPixels& pixels_;
  const std::atomic<bool>* const stop_;
  const BorderSetting setting_;
  const ParameterPlane& plane_ = setting_.plane;
  std::unique_ptr<Engine> engine_;
  std::unique_ptr<DeviceOrbitMap> device_;
  std::unique_ptr<JoinedOrbitMap> joined_;
  std::unique_ptr<SettledPixels> settled_;
  std::vector<ExplainedBorder> borders_;
  std::vector<std::vector<bool>> is_tried_;  // [border][edge]
  std::vector<std::size_t> tries_;           // [border]
  std::mutex curves_mutex_;
  std::vector<BorderCurve> curves_;
  std::vector<PixelLine> lines_;  // [curve]
};

}  // namespace

std::optional<BorderFindings> find_borders(const Study& study, const BorderRequest& request,
                                           const SweepOptions& options) {
  try {
    return BorderSearch(study, request, options).find();
  } catch (const SearchStopped&) {
    return std::nullopt;
  }
}

}  // namespace gearsweep
