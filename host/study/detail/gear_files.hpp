// The files that [gear] names: measured curves, and errors tooth by tooth.
#pragma once

#include <toml++/toml.h>

#include "gear/drawing.hpp"
#include "study/detail/study_files.hpp"

namespace gearsweep {

// The numbers of the files become [gear.tables], so that the study needs no other file any more.
// Throws InputError with the place.
void take_in_gear_files(const StudyFiles& files, toml::table* root);

// What was measured under a key that the table [gear] has: the numbers are in its [gear.tables].
// Throws InputError with the place.
Measured read_measured(const toml::table& gear, const GearKey& key);

}  // namespace gearsweep
