// What was found in a model's equations, as 'gearsweep model' says it.
#pragma once

#include <string>
#include <vector>

#include "equations/definition.hpp"
#include "equations/detail/lowering.hpp"
#include "equations/detail/phase_breaks.hpp"

namespace gearsweep {

// SectionInfo::place.
std::string place_of(const SectionDefinition& section);

// Model::findings: a line each.
std::vector<std::string> findings_of(const ModelDefinition& definition, const Formula& formula,
                                     const Lowered& lowered, const PhaseBreaks& breaks);

// Model::phase_findings: a line each.
std::vector<std::string> phase_findings_of(const ModelDefinition& definition,
                                           const Formula& formula, const Lowered& lowered,
                                           const PhaseBreaks& breaks);

}  // namespace gearsweep
