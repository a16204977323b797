#include "cli/detail/progress_bar.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cli/standard_streams.hpp"

namespace gearsweep {
namespace {

constexpr double kBarEvery = 0.1;    // seconds
constexpr double kLineEvery = 10.0;  // seconds
constexpr double kWarmingUp = 1.0;   // seconds in which there is nothing to say yet

// "  1240 points/s, 3 s left"
std::string describe(const std::optional<Pace>& pace) {
  if (!pace) return "";
  return fmt::format("  {:.0f} points/s, {} left", pace->points_per_second,
                     format_duration(pace->seconds_left));
}

}  // namespace

std::string format_duration(double seconds) {
  if (seconds < 9.95) return fmt::format("{:.1f} s", seconds);
  const auto whole = std::lround(seconds);
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} h {:02} min", whole / 3600, whole % 3600 / 60);
}

ProgressBar::ProgressBar() : on_terminal_(terminal_columns(StandardStream::error).has_value()) {}

void ProgressBar::show(const SweepProgress& progress) {
  pace_ = meter_.at(progress);
  const bool last = progress.points_done == progress.points;
  const double pause = on_terminal_ ? kBarEvery : kLineEvery;
  if (!last && progress.seconds - last_shown_ < pause) return;
  if (!last && !on_terminal_ && progress.seconds < kWarmingUp) return;
  last_shown_ = progress.seconds;
  if (on_terminal_) {
    show_bar(progress);
  } else {
    show_line(progress);
  }
}

void ProgressBar::close() {
  if (bar_open_) tell("\n");
  bar_open_ = false;
}

void ProgressBar::show_bar(const SweepProgress& progress) {
  // The text beside the bar takes up to 45 columns.
  const int width = std::clamp(terminal_columns(StandardStream::error).value_or(80) - 46, 0, 30);
  const int full = static_cast<int>(progress.share * width);
  // The escape sequence clears what a longer line left behind.
  tell_text(fmt::format("\r[{:=>{}}{:>{}}] {:5.1f} %{}\033[K", "", full, "", width - full,
                        100.0 * progress.share, describe(pace_)));
  bar_open_ = true;
}

void ProgressBar::show_line(const SweepProgress& progress) {
  tell("{:5.1f} %  {} of {} points{}\n", 100.0 * progress.share, progress.points_done,
       progress.points, describe(pace_));
}

}  // namespace gearsweep
