#include "report/tolerance_report.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "model/error.hpp"
#include "plot/plot.hpp"
#include "report/detail/page_file.hpp"
#include "report/detail/scatter.hpp"
#include "report/detail/scatter_page.hpp"
#include "result/output_file.hpp"

namespace gearsweep {
namespace {

// The ten worst gears as studies: gear-01.toml, ...
void write_gears(const Scatter& scatter, const std::string& folder) {
  std::filesystem::create_directories(folder);
  for (std::size_t i = 0; i < scatter.worst_gears.size(); ++i) {
    const WorstGear& gear = scatter.worst_gears[i];
    const Study study = read_study(scatter.study.toml, "the study of the report", gear.overrides);
    write_file((std::filesystem::path(folder) / fmt::format("gear-{:02}.toml", i + 1)).string(),
               study.toml);
  }
}

}  // namespace

bool write_tolerance_report(const Study& study, const std::string& path,
                            const ToleranceOptions& options) {
  ensure_page_file(path);
  if (!options.bands_path.empty()) {
    if (!options.bands_path.ends_with(".nc")) {
      throw InputError(fmt::format("cannot write the maps to '{}': its name must end in .nc",
                                   options.bands_path));
    }
    ensure_writable(options.bands_path);
  }
  ensure_plottable(path.substr(0, path.rfind('.')) + ".svg");
  const std::optional<Scatter> scatter = find_scatter(study, options);
  if (!scatter) return false;
  if (options.on_step) options.on_step("pictures");
  if (!options.worst_folder.empty()) write_gears(*scatter, options.worst_folder);
  write_page(scatter_page(*scatter, options), path);
  return true;
}

}  // namespace gearsweep
