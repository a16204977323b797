// Writes a dataset as NetCDF-4, so that xarray, MATLAB, Octave and ncview open it without help.
// The file claims no CF convention: the dimensionless units are not units of UDUNITS.
#pragma once

#include <string>

#include "result/dataset.hpp"

namespace gearsweep {

// Whole or not at all: a failure leaves what was at `path` before. Throws InputError as
// ensure_writable() does, RunError when the disk or the library fails.
void write_dataset(const Dataset& dataset, const std::string& path);

}  // namespace gearsweep
