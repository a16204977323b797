// Maps for programs that do not read NetCDF.
#pragma once

#include <string>
#include <vector>

#include "result/table_units.hpp"

namespace gearsweep {

// Writes quantities of a result file, with its axes, whole or not at all. The end of `out` decides:
//   .csv  a header with names and units, "omega [varpi]", then one row per point, x fastest.
//         Numbers read back to the same double, classes are integers without a unit, a missing
//         value is an empty field. `poincare` has one row per sample, so it stands alone: the axes,
//         sample (from 1), and poincare_STATE for each state. A quantity of several numbers has a
//         column for each: lyapunov_spectrum_1, lyapunov_spectrum_2, ...
//   .npy  NumPy's format: an array [y][x] (or [x]) of records whose fields are the axes and the
//         quantities; `poincare` is a field of shape (state, sample), a quantity of n numbers one
//         of shape (n,). np.load(out)["omega"].
// quantities: each as for ResultFile::read; none: all but poincare. Throws InputError for a name,
// ending or place that will not do, or units that the file does not have; RunError when the disk
// fails.
void export_maps(const std::string& result_path, const std::vector<std::string>& quantities,
                 const std::string& out, TableUnits units = TableUnits::model);

}  // namespace gearsweep
