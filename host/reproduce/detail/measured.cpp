#include "reproduce/detail/measured.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace gearsweep {
namespace {

const std::vector<double>& channel_of(const Trace& trace, const std::string& name) {
  for (std::size_t i = 0; i < trace.channels.size(); ++i) {
    if (trace.channels[i].name == name) return trace.values[i];
  }
  throw std::logic_error("a trace has no channel " + name);
}

}  // namespace

MapCurve::MapCurve(const SweepResult& result, const std::string& quantity)
    : x_(result.study.axes[0].values), values_(map_of(result, quantity)) {}

std::vector<std::size_t> MapCurve::within(double from, double to) const {
  std::vector<std::size_t> points;
  for (std::size_t i = 0; i < x_.size(); ++i) {
    if (x_[i] >= from && x_[i] <= to) points.push_back(i);
  }
  return points;
}

std::size_t MapCurve::max_in(double from, double to) const {
  const std::vector<std::size_t> points = within(from, to);
  if (points.empty()) throw std::logic_error("a curve has no points there");
  return *std::max_element(points.begin(), points.end(),
                           [&](std::size_t a, std::size_t b) { return values_[a] < values_[b]; });
}

std::size_t MapCurve::nearest(double x) const {
  const auto found = std::min_element(
      x_.begin(), x_.end(), [&](double a, double b) { return std::abs(a - x) < std::abs(b - x); });
  return static_cast<std::size_t>(found - x_.begin());
}

double share_of(const std::vector<std::size_t>& points,
                const std::function<bool(std::size_t)>& is_so) {
  if (points.empty()) return 0.0;
  const auto count = std::count_if(points.begin(), points.end(), is_so);
  return static_cast<double>(count) / static_cast<double>(points.size());
}

double amplitude_at(const Trace& trace, const std::string& channel, double order) {
  const std::vector<double>& values = channel_of(trace, channel);
  const double omega = 2.0 * std::numbers::pi * order / trace.period;
  double real = 0.0, imaginary = 0.0;
  for (std::size_t i = 1; i < values.size(); ++i) {
    const double half = 0.5 * (trace.tau[i] - trace.tau[i - 1]);
    const double before = omega * trace.tau[i - 1], after = omega * trace.tau[i];
    real += half * (values[i - 1] * std::cos(before) + values[i] * std::cos(after));
    imaginary += half * (values[i - 1] * std::sin(before) + values[i] * std::sin(after));
  }
  return 2.0 * std::hypot(real, imaginary) / trace.tau.back();
}

std::pair<double, double> range_of(const Trace& trace, const std::string& channel) {
  const std::vector<double>& values = channel_of(trace, channel);
  const auto [min, max] = std::minmax_element(values.begin(), values.end());
  return {*min, *max};
}

}  // namespace gearsweep
