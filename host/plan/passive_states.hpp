// States that a study need not integrate.
//
// A state is passive when it drives nothing that the study looks at: neither a channel, nor a state
// that drives one. It is left out where it follows the others by linear equations with constant
// coefficients that decay: then its Lyapunov exponents are known, it is periodic where the others
// are, and it diverges nowhere. Of two states that mirror each other (Model::mirror_pairs) one is
// left out. The others keep the bits that they have beside them, but where the compiler fuses
// multiplications and additions in another way.
#pragma once

#include <vector>

#include "study/study.hpp"

namespace gearsweep {

// The study with a reduced model that it owns; the study itself where no state can be left out,
// where an observable looks at all of them, or where it asks for all (integrate.states).
Study without_passive_states(const Study& study);

// The Lyapunov exponents, per dimensionless time, that a reduced model does not show: of its
// passive states, and of what would part mirrored ones. The largest first.
std::vector<double> left_out_exponents(const Model& reduced, const ModelSetting& setting);

}  // namespace gearsweep
