#include "cli/detail/pace.hpp"

namespace gearsweep {
namespace {

constexpr double kShortest = 1.0, kEnough = 0.05;  // seconds and share to measure over, at least
constexpr double kLong = 60.0;  // seconds after which building kernels counts for nothing

}  // namespace

std::optional<Pace> PaceMeter::at(const SweepProgress& progress) {
  // What a journal gave does not count as speed.
  const double finished = progress.share_kept - progress.share_resumed;
  if (finished > finished_) {
    finished_ = finished;
    measure(progress);
  }
  if (!measured_) return std::nullopt;
  const double left = pace_.seconds_left - (progress.seconds - *measured_);
  if (left <= 0.0) return std::nullopt;
  return Pace{pace_.points_per_second, left};
}

void PaceMeter::measure(const SweepProgress& progress) {
  if (!first_) {
    first_ = progress.seconds < kLong ? Reading{progress.seconds, progress.share}
                                      : Reading{0.0, progress.share_resumed};
  }
  const double seconds = progress.seconds - first_->seconds;
  const double share = progress.share - first_->share;
  if (seconds < kShortest || (share < kEnough && seconds < kLong) || share <= 0.0) return;
  pace_ = {share * static_cast<double>(progress.points) / seconds,
           seconds * (1.0 - progress.share) / share};
  measured_ = progress.seconds;
}

}  // namespace gearsweep
