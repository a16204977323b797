// The drawings of a study, and what they give it.
#pragma once

#include <toml++/toml.h>

#include <vector>

#include "study/detail/gear_reader.hpp"
#include "study/study.hpp"

namespace gearsweep {

struct StudyDrawing {
  DrawingTable from;
  GearConversion gives;
};

// Parameters, options, scales, notes and notices become the study's. Throws InputError.
std::vector<StudyDrawing> read_drawings(const toml::table& root, Study* study);

}  // namespace gearsweep
