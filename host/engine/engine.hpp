// What an engine does: computes a tile.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "engine/orbit_engine.hpp"
#include "engine/result.hpp"
#include "engine/window.hpp"
#include "model/array.hpp"
#include "plan/plan.hpp"

namespace gearsweep {

// What a tile took.
struct TileCost {
  double steps = 0.0;           // integration steps
  double seconds = 0.0;         // the worker's wall time; in a sweep the tile's share of its time
  double stopped = 0.0;         // points that stopped early, on a periodic orbit
  double kernel_seconds = 0.0;  // of these in kernels
};

// The answers for the points of a tile, in the tile's order.
struct TileResult {
  std::vector<std::uint8_t> status;  // [point]
  std::vector<double> outputs;       // [output of the selection][point]
  std::vector<double> samples;       // [point][chosen state][sample]
  std::vector<double> final_states;  // [point][state], at phase 0 after the last period
  // [point] 1: it stopped on a periodic orbit. Empty in a subset's result and one from a journal.
  std::vector<std::uint8_t> on_orbit;
  TileCost cost;
  std::string device;  // name of the device; the worker sets it

  // The vectors as tables, of a result that has points.
  Array2<double> output_table() { return {outputs, status.size()}; }
  Array2<const double> output_table() const { return {outputs, status.size()}; }
  Array2<double> state_table() { return {final_states, final_states.size() / status.size()}; }
  Array2<const double> state_table() const {
    return {final_states, final_states.size() / status.size()};
  }
  // chosen: how many states are sampled, at least one.
  Array3<double> sample_table(std::size_t chosen) {
    return {samples, chosen, samples.size() / (status.size() * chosen)};
  }
  Array3<const double> sample_table(std::size_t chosen) const {
    return {samples, chosen, samples.size() / (status.size() * chosen)};
  }
};

// Takes the values of a point that did not end ok.
void blank_point(std::size_t point, TileResult* result);

// Memory that an engine's device has for buffers, in bytes.
struct DeviceMemory {
  double all = std::numeric_limits<double>::infinity();
  double one_buffer = std::numeric_limits<double>::infinity();
  bool is_host = true;  // the device's memory is that of this machine
};

// What a tile takes at most, in bytes.
struct TileMemory {
  double device = 0.0;  // in buffers at a time
  double buffer = 0.0;  // in the largest of them
  double host = 0.0;    // beside the buffers, its answers included
};

// A tile's answers on the host, in bytes, for each point.
double answer_bytes(const Study& study);

class Engine {
 public:
  virtual ~Engine() = default;
  virtual EngineInfo info() const = 0;
  virtual DeviceMemory memory() const { return {}; }
  virtual TileMemory tile_memory(const Plan& plan, const Tile& tile) const;
  // Seconds in which its device has run kernels so far, its own or those of another engine there.
  virtual double kernel_seconds() const { return 0.0; }
  // Points per tile when the study does not say: what keeps the engine busy, and what suits it
  // best.
  virtual std::size_t min_tile() const = 0;
  virtual std::size_t preferred_tile() const = 0;
  // Tiles, each with an engine of its own, that keep its device busy.
  virtual std::size_t tiles_at_once() const { return 1; }
  // initial: [point][state], at the beginning of the window. Nothing when the callback asked to
  // stop. Throws RunError.
  virtual std::optional<TileResult> compute(const Plan& plan, const Tile& tile,
                                            const std::vector<double>& initial,
                                            const Window& window,
                                            const RoundCallback& after_round) = 0;
  // The states of one point at both ends of each step of `record` periods, which follow on `settle`
  // others: [row][state], where each segment of a period has a row more than steps. Fewer rows when
  // the point diverges. initial: [state].
  virtual std::optional<std::vector<double>> rows(const Plan& plan, std::size_t point,
                                                  const std::vector<double>& initial,
                                                  std::size_t settle, std::size_t record,
                                                  const RoundCallback& after_round) = 0;
  // Null for an engine that cannot look for orbits.
  virtual OrbitEngine* orbits() { return nullptr; }
};

}  // namespace gearsweep
