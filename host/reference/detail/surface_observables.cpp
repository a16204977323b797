#include "reference/detail/surface_observables.hpp"

#include <algorithm>
#include <optional>

namespace gearsweep {
namespace {

class Sticking final : public ReferenceObservable {
 public:
  void step(const TrajectoryStep& step) override {
    if (step.share <= 0.0) return;
    if (step.stays) time_ += step.weight;
    if (step.stays && was_.has_value() && !*was_) stops_ += step.once;
    was_ = step.stays;
  }
  std::vector<double> finish(const Window& window) const override {
    const auto periods = static_cast<double>(window.record);
    return {time_ / periods, stops_ / periods};
  }

 private:
  double time_ = 0.0, stops_ = 0.0;
  std::optional<bool> was_;
};

class SurfaceImpacts final : public ReferenceObservable {
 public:
  explicit SurfaceImpacts(std::size_t surface) : surface_(surface) {}
  void step(const TrajectoryStep& step) override {
    for (const HeldField::Met& met : step.met) {
      if (met.surface != surface_) continue;
      count_ += step.once_before;
      hardest_ = std::max(hardest_, met.rate);
    }
  }
  std::vector<double> finish(const Window& window) const override {
    return {count_ / static_cast<double>(window.record), hardest_};
  }

 private:
  std::size_t surface_;
  double count_ = 0.0, hardest_ = 0.0;
};

}  // namespace

std::unique_ptr<ReferenceObservable> make_sticking() { return std::make_unique<Sticking>(); }
std::unique_ptr<ReferenceObservable> make_surface_impacts(std::size_t surface) {
  return std::make_unique<SurfaceImpacts>(surface);
}

}  // namespace gearsweep
