// The list that the quantity `attractor` numbers.
#pragma once

#include "result/dataset.hpp"
#include "result/detail/file_notes.hpp"

namespace gearsweep {

// Its dimension, and the coordinate 1, 2, ... along it.
inline constexpr const char* kAttractorNumber = "attractor_number";

// What is known of each attractor, along that dimension, which must be there.
void add_attractors(const SweepResult& result, const FileNotes& notes, Dataset* out);

}  // namespace gearsweep
