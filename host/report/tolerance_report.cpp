#include "report/tolerance_report.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "model/error.hpp"
#include "model/version.hpp"
#include "plot/plot.hpp"
#include "report/detail/page_file.hpp"
#include "report/detail/scatter.hpp"
#include "report/detail/scatter_json.hpp"
#include "report/detail/scatter_page.hpp"
#include "result/output_file.hpp"
#include "result/result_file.hpp"

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

void ensure_files(const std::string& path, const ToleranceOptions& options) {
  if (!path.empty()) {
    ensure_page_file(path);
    ensure_plottable(path.substr(0, path.rfind('.')) + ".svg");
  }
  if (!options.json_path.empty()) {
    if (!options.json_path.ends_with(".json")) {
      throw InputError(fmt::format("cannot write the findings to '{}': its name must end in .json",
                                   options.json_path));
    }
    ensure_writable(options.json_path);
  }
  if (!options.bands_path.empty()) {
    if (!options.bands_path.ends_with(".nc")) {
      throw InputError(fmt::format("cannot write the maps to '{}': its name must end in .nc",
                                   options.bands_path));
    }
    ensure_writable(options.bands_path);
  }
}

}  // namespace

bool write_tolerance_report(const Study& study, const std::string& path,
                            const ToleranceOptions& options) {
  ensure_files(path, options);
  const std::optional<Scatter> scatter = find_scatter(study, options);
  if (!scatter) return false;
  if (!options.bands_path.empty()) {
    write_result(scatter->result, options.bands_path,
                 {options.command_line, version(), source_hash()});
  }
  if (!options.json_path.empty()) write_file(options.json_path, scatter_json(*scatter, options));
  if (!options.worst_folder.empty()) write_gears(*scatter, options.worst_folder);
  if (path.empty()) return true;
  if (options.on_step) options.on_step("pictures");
  write_page(scatter_page(*scatter, options), path);
  return true;
}

std::optional<std::string> tolerance_findings(const Study& study, const ToleranceOptions& options) {
  const std::optional<Scatter> scatter = find_scatter(study, options);
  if (!scatter) return std::nullopt;
  return scatter_json(*scatter, options);
}

}  // namespace gearsweep
