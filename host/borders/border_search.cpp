#include "borders/border_search.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <memory>

#include "borders/crossing.hpp"
#include "borders/curve_accuracy.hpp"
#include "borders/device_orbit_map.hpp"
#include "borders/find_breaking.hpp"
#include "borders/graze_borders.hpp"
#include "borders/joined_orbit_map.hpp"
#include "borders/known_curves.hpp"
#include "borders/mirror_symmetry.hpp"
#include "borders/on_threads.hpp"
#include "borders/search_record.hpp"
#include "borders/settled_pixels.hpp"
#include "model/error.hpp"
#include "orbits/period_map.hpp"
#include "scheduler/make_engine.hpp"

namespace gearsweep {
namespace {

constexpr std::size_t kMinOpen = 3;  // pairs of a border without a reason: worth a search
constexpr std::size_t kMaxRounds = 12;
constexpr std::size_t kRoundSeeds = std::size_t{1} << 24U;  // of a round: more than any map has
constexpr std::size_t kMaxTries = 8;                        // seeds of a border that find nothing
// Places, along each axis, at which mirrored orbits are looked for, and how far from one their
// symmetry may break, in distances to the next.
constexpr std::size_t kMirrorGrid = 24;
constexpr double kBesideMirrored = 1.2, kBesidePixel = 2.5;
constexpr double kBeyondPixel = 1.5;  // from the middle of a pair

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
    host_ = std::make_unique<HostOrbitMap>(plane_, host_steps(*setting_.following), stop_);
    is_mirrored_ = is_mirrored(plane_);
    record_ = std::make_unique<SearchRecord>(identity_of(study, request), options,
                                             engine_->info().device);
    if (record_->parts() > 0) {
      tell(fmt::format("{} parts of the search are there from before", record_->parts()));
    }
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
      grow(round, seeds);
      tell(fmt::format("round {}: {} curves, {} of {} pairs of pixels explained", round + 1,
                       known_.size(), explained(), edges()));
    }
    find_breakings();
    GrazeBorders grazes(plane_, pixels_, host_.get(), device_.get(), settled_.get(), &known_,
                        record_.get());
    if (may_graze()) {
      grazes.from_stops();
      tell(fmt::format("{} curves, those that graze included", known_.size()));
    }
    tell(fmt::format("{} pairs of pixels without a curve are looked at", edges() - explained()));
    take_reasons(record_->numbers({SearchStage::reasons, 0}, [&] {
      explain_without_curves(
          plane_, pixels_, device_.get(), settled_.get(),
          [this](const MapBorder& border, const BorderEdge& edge) {
            return has_curve_beyond(border, edge);
          },
          &borders_);
      return reasons();
    }));
    BorderFindings out;
    if (may_graze()) {
      grazes.from_lost(&borders_);
      out.contacts = grazes.from_contacts(request_.min_edges);
    }
    out.study = *setting_.following;
    out.steps = setting_.following->integrate.steps_per_period;
    out.ranges = {plane_.range(0), plane_.range(1)};
    out.curves = known_.take();
    out.borders = std::move(borders_);
    tell(fmt::format("{} curves: how exact they are, and what moves them", out.curves.size()));
    const CurveJudge judge = {plane_, pixels_, setting_.following, engine_.get(), stop_};
    out.curves = record_->curves({SearchStage::accuracy, 0}, [&] {
      find_step_errors(judge, &out.curves);
      return out.curves;
    });
    if (!out.curves.empty()) find_gradients(judge, &out.curves);
    out.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
    return out;
  }

 private:
  bool may_graze() const {
    const Model& model = plane_.model->full();
    return !model.contacts.empty() || model.corners > 0 || !model.surfaces.empty();
  }

  // Whether a curve that may explain a border passes its pixels nearby.
  bool has_curve_beyond(const MapBorder& border, const BorderEdge& edge) const {
    const PixelPlace middle = middle_of(pixels_, edge);
    for (std::size_t i = 0; i < known_.curves().size(); ++i) {
      if (may_explain(known_.curves()[i], border) &&
          known_.lines()[i].distance_to(middle, true) <= kBeyondPixel) {
        return true;
      }
    }
    return false;
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

  // One edge, in the middle of a stretch, of each border that has enough edges left.
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

  // All reasons, border after border.
  std::vector<double> reasons() const {
    std::vector<double> out;
    for (const ExplainedBorder& border : borders_) {
      for (const EdgeReason reason : border.reasons) out.push_back(static_cast<double>(reason));
    }
    return out;
  }
  void take_reasons(const std::vector<double>& reasons) {
    const bool are_reasons = std::ranges::all_of(reasons, [](double reason) {
      return reason >= 0.0 && reason < static_cast<double>(kEdgeReasons);
    });
    if (!are_reasons || reasons.size() != edges()) {
      throw InputError("the journal is damaged (what stands there are no reasons); delete it");
    }
    std::size_t next = 0;
    for (ExplainedBorder& border : borders_) {
      for (EdgeReason& reason : border.reasons) reason = static_cast<EdgeReason>(reasons[next++]);
    }
  }

  void grow(std::size_t round, const std::vector<Seed>& seeds) {
    const auto part = [&](std::size_t i) {
      return SearchPart{SearchStage::rounds, round * kRoundSeeds + i};
    };
    std::vector<std::size_t> pixels;
    for (std::size_t i = 0; i < seeds.size(); ++i) {
      if (record_->has(part(i))) continue;
      pixels.push_back(seeds[i].from);
      pixels.push_back(seeds[i].to);
    }
    settled_->settle(pixels);
    for_each_in_order(
        seeds.size(), joined_.get(),
        [&](std::size_t i) { return record_->curves(part(i), [&] { return grow(seeds[i]); }); },
        [&](std::size_t, const std::vector<BorderCurve>& curves) { take(curves); });
  }

  // The curve through a seed; none where it is known already.
  std::vector<BorderCurve> grow(const Seed& seed) {
    for (const bool is_back : {false, true}) {
      const std::size_t from = is_back ? seed.to : seed.from, to = is_back ? seed.from : seed.to;
      const HeldOrbit* orbit = settled_->orbit(from);
      if (orbit == nullptr) continue;
      const BorderEdge& edge = borders_[seed.border].border.edges[seed.edge];
      std::optional<Crossing> found = breaking(*orbit, pixels_.place(to), kBesidePixel);
      if (!found) found = find_crossing(plane_, pixels_, joined_.get(), *orbit, to, edge);
      if (is_mirrored_ && found && found->equations->kind() == BorderKind::fold &&
          is_breaking(plane_, host_.get(), *found->equations, found->point)) {
        continue;
      }
      if (found) return follow(*found);
    }
    return {};
  }

  std::optional<Crossing> breaking(const HeldOrbit& orbit, const PlanePlace& there, double reach) {
    if (!is_mirrored_ || !is_own_image(plane_, host_.get(), orbit)) return std::nullopt;
    return find_breaking(plane_, host_.get(), last_stable(plane_, joined_.get(), orbit, there),
                         there, reach);
  }

  // Where a symmetry breaks the period stays what it is. Orbits that are their own images are
  // looked for at some pixels all over the map, beside others that are not.
  void find_breakings() {
    if (!is_mirrored_) return;
    const std::size_t nx = pixels_.columns(), ny = pixels_.axes[1].size();
    const std::size_t dx = (nx + kMirrorGrid - 1) / kMirrorGrid,
                      dy = (ny + kMirrorGrid - 1) / kMirrorGrid;
    std::vector<std::size_t> chosen;
    for (std::size_t y = 0; y < ny; y += dy) {
      for (std::size_t x = 0; x < nx; x += dx) {
        if (pixels_.label(y * nx + x) % 2 == 1) chosen.push_back(y * nx + x);
      }
    }
    settled_->settle(chosen);
    std::vector<char> images(nx * ny, 0);  // 1: it is its own, 2: it is not
    for_each_on_threads(chosen.size(), nullptr, [&](std::size_t i) {
      const HeldOrbit* const orbit = settled_->orbit(chosen[i]);
      if (orbit != nullptr) images[chosen[i]] = is_own_image(plane_, host_.get(), *orbit) ? 1 : 2;
    });
    std::vector<std::array<std::size_t, 2>> pairs;  // from an own image to another motion
    const auto look = [&](std::size_t a, std::size_t b) {
      if (images[a] == 1 && images[b] == 2) pairs.push_back({a, b});
      if (images[a] == 2 && images[b] == 1) pairs.push_back({b, a});
    };
    for (const std::size_t pixel : chosen) {
      if (pixel % nx + dx < nx) look(pixel, pixel + dx);
      if (pixel / nx + dy < ny) look(pixel, pixel + dy * nx);
    }
    const auto find = [&](std::size_t i) -> std::vector<BorderCurve> {
      const std::optional<Crossing> found =
          breaking(*settled_->orbit(pairs[i][0]), pixels_.place(pairs[i][1]), kBesideMirrored);
      return found ? follow(*found) : std::vector<BorderCurve>();
    };
    for_each_in_order(
        pairs.size(), joined_.get(),
        [&](std::size_t i) {
          return record_->curves({SearchStage::breakings, i}, [&] { return find(i); });
        },
        [&](std::size_t, const std::vector<BorderCurve>& curves) { take(curves); });
  }

  std::vector<BorderCurve> follow(const Crossing& found) {
    if (known_.has(*found.equations, found.point)) return {};
    return {follow_border(*found.equations, found.point)};
  }

  void take(const std::vector<BorderCurve>& curves) {
    for (const BorderCurve& curve : curves) take(curve);
  }

  void take(const BorderCurve& curve) {
    const std::optional<PixelLine> line = known_.add(curve);
    if (!line) return;
    for (ExplainedBorder& border : borders_) {
      if (!may_explain(curve, border.border)) continue;
      for (std::size_t i = 0; i < border.reasons.size(); ++i) {
        if (border.reasons[i] == EdgeReason::curve) continue;
        const PixelPlace middle = middle_of(pixels_, border.border.edges[i]);
        if (line->distance_to(middle, true) <= kHalfPixel) border.reasons[i] = EdgeReason::curve;
      }
    }
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
  std::unique_ptr<HostOrbitMap> host_;
  bool is_mirrored_ = false;
  std::unique_ptr<SearchRecord> record_;
  std::unique_ptr<SettledPixels> settled_;
  std::vector<ExplainedBorder> borders_;
  std::vector<std::vector<bool>> is_tried_;  // [border][edge]
  std::vector<std::size_t> tries_;           // [border]
  KnownCurves known_{pixels_};
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
