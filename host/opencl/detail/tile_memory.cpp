#include "opencl/detail/tile_memory.hpp"

#include <algorithm>
#include <initializer_list>
#include <set>
#include <vector>

#include "opencl/detail/buffer_plan.hpp"
#include "opencl/detail/tile_buffers.hpp"
#include "sweep_types.h"

namespace gearsweep {
namespace {

// The buffers that are there at a time, in bytes.
class Buffers {
 public:
  void add(std::size_t bytes) {
    constexpr std::size_t kMin = 64;
    const auto size = static_cast<double>(std::max(kMin, bytes));
    total_ += size;
    largest_ = std::max(largest_, size);
  }
  double total() const { return total_; }
  double largest() const { return largest_; }

 private:
  double total_ = 0.0, largest_ = 0.0;
};

class Estimate {
 public:
  Estimate(const Plan& plan, const Tile& tile, const BufferLayout& layout)
      : plan_(plan),
        study_(plan.study()),
        orbit_plan_(plan.with_shorter_steps(study_.integrate.orbit_steps)),
        selection_(study_.selection),
        tile_(tile),
        layout_(layout),
        states_(study_.model->states.size()),
        searches_(looks_for_orbits(study_)) {}

  TileMemory most() const {
    const Buffers tables = grid_tables();
    std::vector<Buffers> kernels = {recording()};
    if (searches_) kernels.insert(kernels.end(), {approach(), return_map(), replay()});
    TileMemory most;
    for (const Buffers& kernel : kernels) {
      most.device = std::max(most.device, tables.total() + kernel.total());
      most.buffer = std::max({most.buffer, tables.largest(), kernel.largest()});
    }
    // A grid's table stands on the host as it is made, and packed.
    const double scalar = static_cast<double>(layout_.scalar_bytes);
    most.host = std::max(on_host(), tables.total() * (1.0 + 8.0 / scalar));
    return most;
  }

 private:
  std::size_t scalars(std::size_t count) const { return count * layout_.scalar_bytes; }

  // Slots of a subset of the tile whose points stand in so many groups, at most.
  std::size_t slots(std::size_t groups) const {
    const std::size_t points = tile_.points.size();
    return points + std::min(points, groups) * (layout_.lanes - 1);
  }
  std::size_t whole_slots() const { return slots(tile_.grid_starts.size()); }

  Buffers inputs(std::size_t slots) const {
    const std::size_t swept = plan_.points().differing().size();
    Buffers buffers;
    buffers.add(scalars(study_.setting.parameters.size()));
    buffers.add(study_.model->parameters.size() * sizeof(sweep_uint));
    buffers.add(scalars(swept * slots));
    buffers.add(slots / layout_.lanes * sizeof(sweep_uint));
    return buffers;
  }

  Buffers grid_tables() const {
    std::set<std::vector<double>> keys;
    std::size_t rows = 0, segments = 0;
    for (const std::size_t start : tile_.grid_starts) {
      const std::size_t point = tile_.points[start];
      if (!keys.insert(plan_.grid_key(point)).second) continue;
      const std::size_t parts = segment_bounds(*study_.model, plan_.setting_of(point)).size() - 1;
      segments += parts;
      // Each segment rounds its steps up.
      rows += 2 * (orbit_plan_.steps_of(point) + parts) + parts;
    }
    Buffers buffers;
    buffers.add(keys.size() * sizeof(SweepGrid));
    buffers.add(segments * sizeof(sweep_uint));
    buffers.add(scalars(segments));
    buffers.add(scalars(rows * table_width(study_)));
    return buffers;
  }

  Buffers with_inputs(std::initializer_list<std::size_t> numbers) const {
    Buffers buffers = inputs(whole_slots());
    for (const std::size_t count : numbers) buffers.add(scalars(count));
    return buffers;
  }

  Buffers recording() const {
    const auto [state, tangents, accumulators, series, outputs] =
        record_buffers(study_, study_.integrate.record, whole_slots());
    return with_inputs({state, tangents, accumulators, series, outputs});
  }

  // To follow trajectories takes some of these buffers.
  Buffers approach() const {
    const auto [state, periods, sections, ranges, lengths, guesses] =
        approach_buffers(study_, whole_slots());
    return with_inputs({state, periods, sections, ranges, lengths, guesses});
  }

  Buffers return_map() const {
    const auto [state, lengths, derivative] = return_map_buffers(study_, whole_slots());
    return with_inputs({state, lengths, derivative});
  }

  Buffers replay() const {
    const auto [state, log_stretching, sections, accumulators, outputs] =
        replay_buffers(study_, ORBIT_LONGEST, whole_slots());
    return with_inputs({state, log_stretching, sections, accumulators, outputs});
  }

  // Beside the answers: what the points start from, the orbits found, and the largest of what is
  // packed or unpacked. A number is there as the device has it and as a double.
  double on_host() const {
    const std::size_t wide = sizeof(double);
    const std::size_t both = wide + layout_.scalar_bytes;
    const std::size_t sampled = selection_.poincare.size() * study_.integrate.record;
    // A second set of answers is that of the subset that was recorded last; its samples come from a
    // series in the device's order.
    const std::size_t recorded =
        wide * (2 * sampled + states_) + (both + 2 * wide) * selection_.output_count();
    const std::size_t tangents = both * selection_.tangent_count() * states_;
    std::size_t packed = whole_slots() * std::max(recorded, tangents);
    // Heap blocks have a head of 16 bytes. An orbit has two vectors, an attempt at one has three.
    const std::size_t block = 16 + wide * states_;
    std::size_t kept = 4 * wide * states_;
    if (searches_) {
      kept += 2 * (64 + 2 * block);
      const std::size_t maps = whole_slots() * (both + wide) * states_ * states_;
      packed = std::max(packed, maps + tile_.points.size() * (128 + 3 * block));
    }
    return static_cast<double>(packed) + static_cast<double>(tile_.points.size()) *
                                             (static_cast<double>(kept) + answer_bytes(study_));
  }

  const Plan& plan_;
  const Study& study_;
  const Plan orbit_plan_;
  const Selection& selection_;
  const Tile& tile_;
  const BufferLayout layout_;
  const std::size_t states_;
  const bool searches_;
};

}  // namespace

TileMemory max_of_tile(const Plan& plan, const Tile& tile, const BufferLayout& layout) {
  return Estimate(plan, tile, layout).most();
}

}  // namespace gearsweep
