// A bifurcation diagram along one axis of a scene, in strips of nested cells.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "explore/scene.hpp"
#include "sweep/sweep_options.hpp"

namespace gearsweep {

// A line of a map along an axis, at cell k of the other one.
struct Line {
  std::size_t axis = 0;
  std::size_t depth = 0;  // of k
  std::uint64_t k = 0;
};

// Cells on a line. Strip 0 of depth 0 has the cells 0 to 127 of 2^7; strip i of a later depth d has
// those cells of 2^(d + 7) that no strip before it has: 2 (128 i + j) + 1 for j = 0 to 127.
struct Strip {
  static constexpr std::size_t kCells = 128;
  static constexpr std::size_t kMaxDepth = Cell::kMaxDepth - 7;

  std::size_t depth = 0;
  std::uint64_t at = 0;

  bool is_there() const {
    return depth <= kMaxDepth && (depth == 0 ? at == 0 : at >> (depth - 1U) == 0);
  }
};

struct StripMaps {
  // The status of each cell and each quantity [map][cell], then the samples [state][cell][sample],
  // NaN where there is none.
  std::vector<double> numbers;
  std::size_t samples = 0;  // of each cell and state: the last ones of its record
  double seconds = 0.0;     // that it took
};

// Nothing when stopped. Throws as run_sweep() does.
std::optional<StripMaps> compute_strip(const Scene& scene, const Line& line, const Strip& strip,
                                       const SweepOptions& options);

}  // namespace gearsweep
