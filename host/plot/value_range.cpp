#include "plot/value_range.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "model/error.hpp"
#include "plot/colours.hpp"

namespace gearsweep {
namespace {

std::vector<double> finite(const std::vector<double>& values) {
  std::vector<double> out;
  std::copy_if(values.begin(), values.end(), std::back_inserter(out),
               [](double value) { return std::isfinite(value); });
  return out;
}

ValueRange not_empty(const ValueRange& range) {
  const double smallest = std::max(1e-9 * std::abs(range.min), 1e-300);
  if (range.max - range.min >= smallest) return range;
  const double half = range.min == 0.0 ? 0.5 : 0.05 * std::abs(range.min);
  return {range.min - half, range.min + half, false};
}

// From the smallest value that has a logarithm.
ValueRange above_zero(const ValueRange& range, const std::vector<double>& values) {
  if (range.min > 0.0) return range;
  double min = std::numeric_limits<double>::infinity();
  for (const double value : values) {
    if (value > 0.0) min = std::min(min, value);
  }
  if (!(min < range.max)) {
    throw InputError("--log: no value is greater than 0, so none has a logarithm");
  }
  return {min, range.max, range.clipped};
}

}  // namespace

Beyond beyond(const ValueRange& range, const std::vector<double>& values) {
  Beyond out;
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    out.below = out.below || value < range.min;
    out.above = out.above || value > range.max;
  }
  return out;
}

ValueRange limited(const ValueRange& range, const Limits& limits, const std::string& option) {
  ValueRange out = range;
  if (limits.min) out.min = *limits.min;
  if (limits.max) out.max = *limits.max;
  if (limits.min && limits.max) out.clipped = false;
  if (out.min < out.max) return out;
  throw InputError(fmt::format("{}: nothing lies there; the values go from {:.6g} to {:.6g}",
                               option, range.min, range.max));
}

ValueRange scale_range(const ValueRange& range, const std::vector<double>& values,
                       const Limits& limits, bool is_log, const std::string& option) {
  if (!is_log) return limited(range, limits, option);
  for (const std::optional<double>& end : {limits.min, limits.max}) {
    if (!end || *end > 0.0) continue;
    throw InputError(fmt::format("{}: with --log its ends must be above 0, not {}", option, *end));
  }
  return limited(limits.min ? range : above_zero(range, values), limits, option);
}

ValueRange colour_range(const std::vector<double>& values) {
  std::vector<double> sorted = finite(values);
  if (sorted.empty()) return {};
  std::sort(sorted.begin(), sorted.end());
  const std::size_t left_out = sorted.size() / 1000;
  ValueRange range = {sorted.front(), sorted.back(), false};
  const double min = sorted[left_out];
  const double max = sorted[sorted.size() - 1 - left_out];
  constexpr double kMuchWider = 3.0;
  if (max > min && sorted.back() - sorted.front() > kMuchWider * (max - min)) {
    range = {min, max, true};
  }
  return not_empty(range);
}

ValueRange with_middle(const std::string& colormap, const std::string& quantity,
                       const ValueRange& range) {
  if (!is_diverging(colormap) || !is_signed(quantity)) return range;
  return {std::min(range.min, 0.0), std::max(range.max, 0.0), range.clipped};
}

ValueRange padded_range(const std::vector<double>& values) {
  const std::vector<double> known = finite(values);
  if (known.empty()) return {};
  const auto [min, max] = std::minmax_element(known.begin(), known.end());
  const double margin = 0.04 * (*max - *min);
  return not_empty({*min - margin, *max + margin, false});
}

}  // namespace gearsweep
