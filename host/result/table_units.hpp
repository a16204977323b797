// The units that the numbers of a table are written in.
#pragma once

namespace gearsweep {

// model: dimensionless, as they were computed. si: rpm, um, mm/s, N, N/um and s, where a study has
// a [gear] table.
enum class TableUnits { model, si };

}  // namespace gearsweep
