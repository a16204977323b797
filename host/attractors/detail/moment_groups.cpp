#include "attractors/detail/moment_groups.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <queue>
#include <utility>

namespace gearsweep {
namespace {

// Two halves of one heap are less apart than this many of their widths: 2.7 of a normal one, 3.5 of
// an even one.
constexpr double kApart = 4.5;
// The errors of few values are known badly, and their spread not at all: so many errors more for
// single ones.
constexpr double kApartOfOne = 9.0;
// What the errors leave out (a settling that goes on, a motion that is slower than a block), in
// standard deviations of the motion.
constexpr double kFloor = 2e-3;

// Values that lie next to each other, with the numbers that describe them. Values are counted from
// one of their own, so that an offset takes no digits.
struct Heap {
  double count = 0.0, sum = 0.0, squares = 0.0, error_squares = 0.0;
  std::size_t begin = 0, end = 0;  // in the sorted values
  std::size_t before = 0, after = 0;
  std::size_t version = 0;  // grows with each change
  bool is_gone = false;

  double mean() const { return sum / count; }
  double width() const {
    const double spread = std::sqrt(std::max(0.0, squares / count - mean() * mean()));
    return std::max(spread, std::sqrt(error_squares / count));
  }
};

// How far two heaps are apart: from 1 on they stay so.
double apartness(const Heap& a, const Heap& b, double floor) {
  const double width = std::max({a.width(), b.width(), floor});
  const double distance = b.mean() - a.mean();
  if (!(distance > 0.0)) return 0.0;
  const double needed =
      std::sqrt(kApart * kApart + kApartOfOne * kApartOfOne * (1.0 / a.count + 1.0 / b.count));
  return distance / (width * needed);
}

// One moment of the members of a group.
struct MomentOfAll {
  struct One {
    double value = 0.0, error = 0.0;
    std::size_t member = 0;
  };
  std::vector<One> sorted;  // by value
  double floor = 0.0;
};

struct Split {
  std::vector<std::size_t> begins;  // of each heap in the sorted values
  double apartness = 0.0;           // of the two that are least so; 0 of a single heap
};

// Heaps of equal numbers, for a start: joining is for what differs.
std::vector<Heap> finest(const MomentOfAll& moment) {
  constexpr double kFine = 0.25;  // of the floor
  std::vector<Heap> heaps;
  const double origin = moment.sorted.front().value;
  for (std::size_t i = 0; i < moment.sorted.size(); ++i) {
    const double value = moment.sorted[i].value, error = moment.sorted[i].error;
    if (i == 0 || value - moment.sorted[heaps.back().begin].value > kFine * moment.floor) {
      heaps.emplace_back();
      heaps.back().begin = i;
    }
    Heap& heap = heaps.back();
    heap.end = i + 1;
    heap.count += 1.0;
    heap.sum += value - origin;
    heap.squares += (value - origin) * (value - origin);
    heap.error_squares += error * error;
  }
  for (std::size_t i = 0; i < heaps.size(); ++i) {
    heaps[i].before = i == 0 ? heaps.size() : i - 1;
    heaps[i].after = i + 1;
  }
  return heaps;
}

Split split(const MomentOfAll& moment) {
  struct Pair {
    double apartness;
    std::size_t left, right, left_version, right_version;
    bool operator>(const Pair& other) const {
      return apartness != other.apartness ? apartness > other.apartness : left > other.left;
    }
  };
  std::vector<Heap> heaps = finest(moment);
  std::priority_queue<Pair, std::vector<Pair>, std::greater<>> nearest;
  const auto add = [&](std::size_t left, std::size_t right) {
    if (left >= heaps.size() || right >= heaps.size()) return;
    nearest.push({apartness(heaps[left], heaps[right], moment.floor), left, right,
                  heaps[left].version, heaps[right].version});
  };
  for (std::size_t i = 0; i + 1 < heaps.size(); ++i) add(i, i + 1);
  Split found;
  while (!nearest.empty()) {
    const Pair pair = nearest.top();
    nearest.pop();
    Heap& left = heaps[pair.left];
    Heap& right = heaps[pair.right];
    if (left.is_gone || right.is_gone || left.version != pair.left_version ||
        right.version != pair.right_version) {
      continue;
    }
    if (pair.apartness >= 1.0) {
      found.apartness = pair.apartness;
      break;
    }
    left.count += right.count;
    left.sum += right.sum;
    left.squares += right.squares;
    left.error_squares += right.error_squares;
    left.end = right.end;
    left.after = right.after;
    if (right.after < heaps.size()) heaps[right.after].before = pair.left;
    right.is_gone = true;
    ++left.version;
    add(left.before, pair.left);
    add(pair.left, left.after);
  }
  for (const Heap& heap : heaps) {
    if (!heap.is_gone) found.begins.push_back(heap.begin);
  }
  return found;
}

class Grouping {
 public:
  Grouping(const std::vector<TrajectorySummary>& summaries, double rounding)
      : summaries_(summaries), rounding_(rounding) {}

  void add(const std::vector<std::size_t>& members) {
    std::vector<std::vector<std::size_t>> open = {members};
    while (!open.empty()) {
      const std::vector<std::size_t> group = std::move(open.back());
      open.pop_back();
      std::vector<std::vector<std::size_t>> parts = parts_of(group);
      if (parts.size() == 1) {
        groups_.members.push_back(group);
      } else {
        std::ranges::move(parts, std::back_inserter(open));
      }
    }
  }

  MomentGroups take() {
    for (std::vector<std::size_t>& members : groups_.members) std::ranges::sort(members);
    std::ranges::sort(groups_.members);
    std::ranges::sort(groups_.uncertain);
    const auto same = std::unique(groups_.uncertain.begin(), groups_.uncertain.end());
    groups_.uncertain.erase(same, groups_.uncertain.end());
    return std::move(groups_);
  }

 private:
  MomentOfAll moment_of(const std::vector<std::size_t>& members, std::size_t number) const {
    const std::size_t states = summaries_[members.front()].place.size() / 2;
    const std::size_t deviation = states + number % states;
    MomentOfAll moment;
    moment.sorted.reserve(members.size());
    double deviations = 0.0;
    for (const std::size_t member : members) {
      const TrajectorySummary& summary = summaries_[member];
      const double error = summary.errors[number];
      moment.sorted.push_back({summary.place[number],
                               error >= 0.0 ? error : std::numeric_limits<double>::infinity(),
                               member});
      deviations += summary.place[deviation];
    }
    std::ranges::sort(moment.sorted, {},
                      [](const MomentOfAll::One& one) { return std::pair(one.value, one.member); });
    moment.floor = std::max(kFloor * deviations / static_cast<double>(members.size()), rounding_);
    return moment;
  }

  // By the moment that parts them best; all of them when none does.
  std::vector<std::vector<std::size_t>> parts_of(const std::vector<std::size_t>& members) {
    if (members.size() == 1) return {members};
    Split best;
    MomentOfAll by;
    for (std::size_t i = 0; i < summaries_[members.front()].place.size(); ++i) {
      MomentOfAll moment = moment_of(members, i);
      Split candidate = split(moment);
      if (candidate.apartness <= best.apartness) continue;
      best = std::move(candidate);
      by = std::move(moment);
    }
    if (best.apartness == 0.0) return {members};
    std::vector<std::vector<std::size_t>> parts;
    for (std::size_t heap = 0; heap < best.begins.size(); ++heap) {
      const bool is_last = heap + 1 == best.begins.size();
      const std::size_t end = is_last ? by.sorted.size() : best.begins[heap + 1];
      std::vector<std::size_t>& part = parts.emplace_back();
      for (std::size_t i = best.begins[heap]; i < end; ++i) part.push_back(by.sorted[i].member);
      if (!is_last) note_uncertain(by, end);
    }
    return parts;
  }

  // border: index of the first sorted value beyond it.
  void note_uncertain(const MomentOfAll& by, std::size_t border) {
    const double middle = 0.5 * (by.sorted[border - 1].value + by.sorted[border].value);
    for (const MomentOfAll::One& one : by.sorted) {
      if (std::abs(one.value - middle) <= one.error) groups_.uncertain.push_back(one.member);
    }
  }

  const std::vector<TrajectorySummary>& summaries_;
  const double rounding_;
  MomentGroups groups_;
};

}  // namespace

MomentGroups group_by_moments(const std::vector<TrajectorySummary>& summaries,
                              const std::vector<std::size_t>& members, double rounding) {
  Grouping grouping(summaries, rounding);
  grouping.add(members);
  return grouping.take();
}

}  // namespace gearsweep
