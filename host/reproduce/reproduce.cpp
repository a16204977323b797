#include "reproduce/reproduce.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "model/error.hpp"
#include "plot/plot.hpp"
#include "reproduce/detail/pictures.hpp"
#include "reproduce/detail/report.hpp"
#include "reproduce/detail/runs.hpp"
#include "result/output_file.hpp"

namespace gearsweep {
namespace {

void make_folder(const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  std::error_code ignored;
  if (!std::filesystem::is_directory(folder, ignored)) {
    throw InputError(fmt::format("{}: cannot be made a folder ({})", folder, error.message()));
  }
  ensure_writable(folder + "/report.md");
}

}  // namespace

bool reproduce(const ReproduceOptions& options) {
  make_folder(options.folder);
  ensure_plottable(options.folder + "/report.png");
  const std::optional<MeasuredFigures> measured = run_figures(options);
  if (!measured) return false;
  if (options.on_step) options.on_step("pictures");
  const std::string pictures = plot_pictures(*measured, options.folder);
  write_file(options.folder + "/report.md", report_on(*measured) + pictures);
  return true;
}

}  // namespace gearsweep
