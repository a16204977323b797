// Numbers that a function works with, on the stack unless they are many.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace gearsweep {

class Scratch {
 public:
  explicit Scratch(std::size_t size) : many_(size > few_.size() ? size : 0) {}
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  double* data() { return many_.empty() ? few_.data() : many_.data(); }

 private:
  std::array<double, 256> few_;
  std::vector<double> many_;
};

}  // namespace gearsweep
