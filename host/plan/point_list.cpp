#include "plan/point_list.hpp"

#include <algorithm>

namespace gearsweep {

std::size_t PointList::Iterator::operator*() const {
  return list_->runs_[run_].point(static_cast<std::uint32_t>(step_));
}

PointList::Iterator& PointList::Iterator::operator++() {
  ++step_;
  if (list_->start(run_) + step_ == list_->runs_[run_].end) {
    ++run_;
    step_ = 0;
  }
  return *this;
}

PointList::Iterator PointList::Iterator::operator++(int) {
  const Iterator before = *this;
  ++*this;
  return before;
}

void PointList::push_back(std::size_t point) {
  const auto added = static_cast<std::uint32_t>(point);
  if (!runs_.empty()) {
    Run& last = runs_.back();
    const std::uint32_t count = last.end - start(runs_.size() - 1);
    // Any two points make a run.
    if (count == 1) last.spacing = added - last.first;
    if (last.point(count) == added) {
      ++last.end;
      return;
    }
  }
  runs_.push_back({added, 0, static_cast<std::uint32_t>(size()) + 1});
}

std::size_t PointList::operator[](std::size_t i) const {
  const auto run = std::upper_bound(
      runs_.begin(), runs_.end(), i,
      [](std::size_t position, const Run& candidate) { return position < candidate.end; });
  const std::uint32_t before = run == runs_.begin() ? 0 : (run - 1)->end;
  return run->point(static_cast<std::uint32_t>(i) - before);
}

}  // namespace gearsweep
