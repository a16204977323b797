// The part of a model's kernel header about its surfaces.
#pragma once

#include "equations/detail/kernel_text.hpp"
#include "equations/detail/lowering.hpp"

namespace gearsweep {

// How many there are, and of what kind.
void write_surface_lists(const Lowered& lowered, KernelText* text);
// Their levels, what a motion that stays at one keeps, and resets; and the derivatives of these.
void write_surfaces(Formula* formula, const Lowered& lowered, KernelText* text);

}  // namespace gearsweep
