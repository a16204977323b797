// Runs what `gearsweep reproduce` measures, and keeps each result in its folder.
#pragma once

#include "reproduce/detail/measured.hpp"
#include "reproduce/reproduce.hpp"

namespace gearsweep {

// Names of the built-in studies behind the figures, without the preset.
const std::vector<std::string>& figure_names();

// Nothing when stopped.
std::optional<MeasuredFigures> run_figures(const ReproduceOptions& options);

}  // namespace gearsweep
