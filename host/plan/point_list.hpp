// Indices of points, as runs of even spacing: a plan of a hundred million points takes next to no
// memory, since the points that share a phase grid stand in rows or in columns of the map.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <iterator>
#include <vector>

namespace gearsweep {

// Reads like a vector; [i] takes the logarithm of the number of runs.
class PointList {
 public:
  class Iterator {
   public:
    using iterator_category = std::forward_iterator_tag;
    using value_type = std::size_t;
    using difference_type = std::ptrdiff_t;
    using pointer = const std::size_t*;
    using reference = std::size_t;

    Iterator() = default;
    Iterator(const PointList* list, std::size_t run) : list_(list), run_(run) {}
    std::size_t operator*() const;
    Iterator& operator++();
    Iterator operator++(int);
    bool operator==(const Iterator& other) const = default;

   private:
    const PointList* list_ = nullptr;
    std::size_t run_ = 0, step_ = 0;  // in the run
  };

  PointList() = default;
  PointList(std::initializer_list<std::size_t> points) {
    for (const std::size_t point : points) push_back(point);
  }

  // point: below 2^32, as every study's are.
  void push_back(std::size_t point);
  std::size_t size() const { return runs_.empty() ? 0 : runs_.back().end; }
  bool empty() const { return runs_.empty(); }
  std::size_t operator[](std::size_t i) const;
  std::size_t front() const { return runs_.front().first; }
  std::size_t back() const { return (*this)[size() - 1]; }
  Iterator begin() const { return {this, 0}; }
  Iterator end() const { return {this, runs_.size()}; }

 private:
  // Spacing wraps around, so that it may be negative.
  struct Run {
    std::uint32_t first, spacing;
    std::uint32_t end;  // of its positions in the list
    std::size_t point(std::uint32_t step) const {
      return static_cast<std::uint32_t>(first + spacing * step);
    }
  };

  // The position where a run begins.
  std::uint32_t start(std::size_t run) const { return run == 0 ? 0 : runs_[run - 1].end; }

  std::vector<Run> runs_;
};

}  // namespace gearsweep
