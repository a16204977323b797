// What whoever gave a study may not expect of it, such as which of two values wins.
#pragma once

#include <toml++/toml.h>

#include <vector>

#include "study/detail/study_drawings.hpp"
#include "study/study.hpp"

namespace gearsweep {

// Adds to the study's notices. `root` is all of its text.
void note_what_wins(const toml::table& root, const std::vector<StudyDrawing>& drawings,
                    Study* study);

// Adds what the study's model says of its settings (Model::notices). Throws InputError as that
// does.
void note_what_the_model_says(Study* study);

}  // namespace gearsweep
