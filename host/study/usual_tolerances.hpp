// Tolerances for a gear study that names none of its own.
#pragma once

#include <string>
#include <vector>

#include "study/study.hpp"

namespace gearsweep {

struct UsualTolerance {
  std::string name;          // of an entry of [uncertain]
  std::string distribution;  // that entry, as TOML has it
  std::string reason;        // what it rests on, a sentence without its full stop
};

// What the drawings of a study leave open. Errors of the flanks are those of
// ISO 1328-1:2013 of this class (gear/tolerance_class.hpp), of which three standard deviations are
// the tolerance; all others are estimates, which the reasons say. What an axis gives is left out.
// Throws InputError for a study without a drawing, or gears to which the standard does not
// apply.
std::vector<UsualTolerance> usual_tolerances(const Study& study, int tolerance_class);

// The entry of [uncertain] of this name with a distribution `factor` times as wide about its
// middle, as TOML has it; empty for measured values, which have no width. The name must be there.
std::string scaled_tolerance(const Study& study, const std::string& name, double factor);

// What makes a study the one of a draw (from 0), as overrides of it: "gear.torque_N_m=61.2". Where
// draws are factors of what an axis gives, the axis has its values times the factor. Throws
// InputError where that is not the draw: the parameter is not in proportion to the axis.
std::vector<std::string> overrides_of_draw(const Study& study, std::size_t draw);

}  // namespace gearsweep
