#include "plan/view_points.hpp"

#include <fmt/format.h>

#include <cmath>

#include "model/error.hpp"
#include "plan/study_points.hpp"

namespace gearsweep {
namespace {

constexpr std::size_t kMaxDepth = 52;  // of the numbers between 1/2 and 1 a double has 2^52

double value_at(const Axis& axis, std::uint64_t cell, std::size_t depth) {
  return value_at_share(axis, std::ldexp(static_cast<double>(cell), -static_cast<int>(depth)));
}

}  // namespace

double value_at_share(const Axis& axis, double share) {
  const double low = axis.values.front(), high = axis.values.back();
  if (share == 1.0) return high;
  if (axis.logarithmic) return low * std::pow(high / low, share);
  return low + (high - low) * share;
}

ViewPoints::ViewPoints(std::shared_ptr<const Study> study, const View& view, bool is_finer)
    : study_(std::move(study)), view_(view), is_finer_(is_finer) {
  if (study_->axes.size() != 2 || study_->members() != 1 || study_->is_chained()) {
    throw InputError("a view takes a study of two axes whose points start on their own, once each");
  }
  if (view.depth > kMaxDepth) {
    throw InputError(fmt::format("depth {} of a view; at most {}", view.depth, kMaxDepth));
  }
  const std::uint64_t cells = (std::uint64_t{1} << view.depth) + 1;  // the end of the axis, too
  for (std::size_t i = 0; i < 2; ++i) {
    const Axis& axis = study_->axes[i];
    if (axis.is_list || !axis.columns.empty() || axis.is_state) {
      throw InputError(
          fmt::format("a view takes axes of one parameter each; '{}' is none", axis.name));
    }
    const ViewSpan& span = view.axes[i];
    if (span.count == 0 || span.count > cells || span.first > cells - span.count) {
      throw InputError(fmt::format("cells {} to {} of '{}' at depth {}; it has {}", span.first,
                                   span.first + span.count, axis.name, view.depth, cells));
    }
    const bool is_even = span.first % 2 == 0 && span.count % 2 == 0;
    if (is_finer && !is_even) {
      throw InputError("what is finer than a view begins at even cells and has an even number");
    }
    differing_.push_back(axis.index);
  }
  if (static_cast<double>(view.axes[0].count) * static_cast<double>(view.axes[1].count) >= 0x1p32) {
    throw InputError("a view of 2^32 points or more");
  }
}

std::size_t ViewPoints::size() const {
  const std::size_t all = view_.axes[0].count * view_.axes[1].count;
  return is_finer_ ? all / 4 * 3 : all;
}

std::string ViewPoints::key() const {
  const auto& [x, y] = view_.axes;
  return fmt::format("a view at depth {}, cells {} + {} by {} + {}{}", view_.depth, x.first,
                     x.count, y.first, y.count, is_finer_ ? ", finer" : "");
}

// Finer: of an even row every other cell is new, of an odd one all are.
std::array<std::size_t, 2> ViewPoints::cell_of(std::size_t point) const {
  const std::size_t columns = view_.axes[0].count;
  if (!is_finer_) return {point % columns, point / columns};
  const std::size_t of_two = columns / 2 + columns, rest = point % of_two;
  const std::size_t row = point / of_two * 2;
  if (rest < columns / 2) return {2 * rest + 1, row};
  return {rest - columns / 2, row + 1};
}

std::array<double, 2> ViewPoints::place_of(const std::array<std::size_t, 2>& cell) const {
  std::array<double, 2> place{};
  for (std::size_t i = 0; i < 2; ++i) {
    place[i] = value_at(study_->axes[i], view_.axes[i].first + cell[i], view_.depth);
  }
  return place;
}

void ViewPoints::set(std::size_t point, ModelSetting* setting) const {
  const std::array<double, 2> place = place_of(cell_of(point));
  for (std::size_t i = 0; i < 2; ++i) setting->parameters[study_->axes[i].index] = place[i];
  study_->model->derive(setting);
}

std::vector<double> ViewPoints::start(std::size_t point) const {
  ModelSetting setting = study_->setting;
  set(point, &setting);
  return start_of_policy(*study_, setting);
}

}  // namespace gearsweep
