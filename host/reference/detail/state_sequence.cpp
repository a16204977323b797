#include "reference/detail/state_sequence.hpp"

#include <algorithm>

namespace gearsweep {
namespace {

// By how much what does not recur must miss, in terms of what does (kernels/recurrence.h).
constexpr double kClear = 100.0;

}  // namespace

void StateSequence::begin(const Eigen::VectorXd& state) {
  states_.push_back(state);
  range_.begin(state);
  if (is_local_) ranges_.emplace_back(Eigen::VectorXd::Zero(state.size()));
}

void StateSequence::add(const Eigen::VectorXd& state) {
  states_.push_back(state);
  const Eigen::VectorXd ranges = range_.end_period(state);
  if (is_local_) ranges_.push_back(ranges);
}

double StateSequence::distance(std::size_t i, std::size_t j) const {
  if (!is_local_) return range_.distance(states_[i], states_[j]);
  Eigen::VectorXd ranges = ranges_[j + 1];
  for (std::size_t k = j + 2; k <= i; ++k) ranges = ranges.cwiseMax(ranges_[k]);
  return range_.distance(states_[i], states_[j], ranges);
}

double StateSequence::closest(std::size_t longest_window) const {
  double closest = std::numeric_limits<double>::infinity();
  for (const Reference& reference : references(longest_window)) {
    const std::size_t last = std::min(reference.window_end, reference.section + longest_window / 2);
    for (std::size_t i = reference.section + 1; i <= last; ++i) {
      closest = std::min(closest, distance(i, reference.section));
    }
  }
  return closest;
}

Recurrence StateSequence::recurrence(std::size_t longest_window) const {
  if (is_empty()) return {};
  for (std::size_t period = 1; period <= longest_window / 2; ++period) {
    const Stretch stretch = final_stretch(period, longest_window);
    if (stretch.recurrences >= 2 && 4 * (last() - stretch.since) >= last()) {
      if (stretch.nearest < kClear * stretch.worst) return {};
      return {period, stretch.since, stretch.worst};
    }
  }
  return {};
}

double StateSequence::extent(std::size_t first, std::size_t final) const {
  if (first > final || last() == 0) return 0.0;
  Eigen::ArrayXd min = states_[first], max = states_[first];
  for (std::size_t i = first; i <= final; ++i) {
    min = min.min(states_[i].array());
    max = max.max(states_[i].array());
  }
  return range_.size((max - min).matrix());
}

std::vector<StateSequence::Reference> StateSequence::references(std::size_t longest_window) const {
  std::vector<Reference> references;
  std::size_t window = 1;
  for (std::size_t section = 0; section < last(); section = references.back().window_end) {
    references.push_back({section, std::min(section + window, last())});
    window = std::min(2 * window, longest_window);
  }
  return references;
}

std::optional<StateSequence::Stretch> StateSequence::with(const Reference& reference,
                                                          std::size_t period, std::size_t most,
                                                          Stretch stretch) const {
  for (std::size_t i = reference.section + 1; i <= reference.window_end; ++i) {
    const std::size_t lag = i - reference.section;
    const bool is_multiple = lag % period == 0;
    if (!is_multiple && lag > most) continue;
    const double apart = distance(i, reference.section);
    if ((apart <= tolerance_) != is_multiple) return std::nullopt;
    if (is_multiple) {
      ++stretch.recurrences;
      stretch.since = reference.section;
      stretch.worst = std::max(stretch.worst, apart);
    } else {
      stretch.nearest = std::min(stretch.nearest, apart);
    }
  }
  return stretch;
}

StateSequence::Stretch StateSequence::final_stretch(std::size_t period,
                                                    std::size_t longest_window) const {
  const std::vector<Reference> all = references(longest_window);
  Stretch stretch;
  for (auto reference = all.rbegin(); reference != all.rend(); ++reference) {
    const std::optional<Stretch> longer = with(*reference, period, longest_window / 2, stretch);
    if (!longer) break;
    stretch = *longer;
  }
  return stretch;
}

}  // namespace gearsweep
