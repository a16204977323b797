// Signals that a model gains for what looks at its sections and contacts.
#pragma once

#include <vector>

#include "equations/definition.hpp"
#include "equations/detail/formula.hpp"
#include "equations/detail/lowering.hpp"
#include "model/model.hpp"

namespace gearsweep {

// A motion without a clock is looked at where its first state that moves, and is no angle, is
// largest, where its file and the study say nothing else and Binding::looked_at no other; where a
// surface resets that state, right behind the surface: the state may have no maximum then. Of
// angles alone the sine of the first is looked at, which is largest once in a turn, and once in a
// swing.
// Whether it is the maxima of a state.
bool add_own_section(ModelDefinition* definition, Formula* formula);

// The sections, whose signals are lowered, and get their names here. Throws InputError where a name
// is taken.
std::vector<SectionInfo> add_section_signals(const Formula& formula, ModelDefinition* definition);

// The contacts, with the signals that what looks at them needs. Throws InputError where a name is
// taken.
std::vector<ContactInfo> add_contact_signals(const Formula& formula, ModelDefinition* definition,
                                             Lowered* lowered);

}  // namespace gearsweep
