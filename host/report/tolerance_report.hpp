// A report on gears as they are built: what the tolerances of a drawing do to its dynamics over
// speed, which of them matters, and which gears are the worst.
#pragma once

#include <optional>
#include <string>

#include "report/report.hpp"
#include "study/as_built.hpp"

namespace gearsweep {

struct ToleranceOptions : ReportOptions, AsBuiltOptions {
  // The half width of this percentile's 95 % interval at the worst speed that is enough, relative
  // to its value; gears are added until it is reached. Nothing: as many gears as above.
  std::optional<double> width;
  std::string worst_folder;  // where the ten worst gears go as studies; empty: nowhere
  std::string bands_path;    // where the maps go, .nc; empty: nowhere
  std::string json_path;     // where the findings go; empty: nowhere
  // Where the runs over all speeds keep their journals, each with "-" and its number of gears
  // behind it; empty: nowhere.
  std::string journal_path;
};

// Runs what the report takes and writes it as write_report() does; with an empty path the files of
// the options alone. Throws as that, and InputError for a study with a second axis, or without
// [gear] and [uncertain].
bool write_tolerance_report(const Study& study, const std::string& path,
                            const ToleranceOptions& options);

// What the page says, for programs: the text of a JSON object (doc/tolerances.md). Nothing when
// stopped. Throws as above; of the options' files it writes the journals alone.
std::optional<std::string> tolerance_findings(const Study& study, const ToleranceOptions& options);

}  // namespace gearsweep
