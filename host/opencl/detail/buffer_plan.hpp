// The buffers that each kernel of a tile has on the device: from this they are allocated, and from
// this the memory that a tile needs is added up.
#pragma once

#include <cstddef>

#include "study/study.hpp"

namespace gearsweep {

// How many numbers each buffer has, in the study's precision, for `slots` slots (a slot is a
// lane of a work-item, tile_buffers.hpp).

// To settle and record: each point's state, its tangent vectors, the sums of its observers, the
// series of its samples, its outputs.
struct RecordBuffers {
  std::size_t state, tangents, accumulators, series, outputs;
};
RecordBuffers record_buffers(const Study& study, std::size_t samples, std::size_t slots);

// To see where a trajectory nearly comes back: lengths and guesses are those of the orbit that is
// supposed there.
struct ApproachBuffers {
  std::size_t state, periods, sections, ranges, lengths, guesses;
};
ApproachBuffers approach_buffers(const Study& study, std::size_t slots);

// To map states by so many periods each, with the map's derivative.
struct ReturnMapBuffers {
  std::size_t state, lengths, derivative;
};
ReturnMapBuffers return_map_buffers(const Study& study, std::size_t slots);

// To repeat one turn of `length` periods of an orbit.
struct ReplayBuffers {
  std::size_t state, log_stretching, sections, accumulators, outputs;
};
ReplayBuffers replay_buffers(const Study& study, std::size_t length, std::size_t slots);

}  // namespace gearsweep
