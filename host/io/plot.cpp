#include "io/plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "io/gnuplot.hpp"
#include "io/output_file.hpp"
#include "io/plot_sources.hpp"
#include "io/plot_text.hpp"
#include "io/result_file.hpp"
#include "io/trace_file.hpp"
#include "model/error.hpp"

namespace gearsweep {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kScriptEnding = ".gp";

std::string terminal_of(const std::string& output, const PlotScript& drawn) {
  const bool large = drawn.for_column;
  if (output.ends_with(".png")) {
    return fmt::format(
        "pngcairo size 1400,{:.0f} font 'DejaVu Sans,{}' linewidth {} background 'white'",
        1400 * drawn.height, large ? 28 : 17, large ? 2.4 : 1.6);
  }
  if (output.ends_with(".svg")) {
    return fmt::format("svg size 1000,{:.0f} font 'DejaVu Sans,{}' linewidth {} background 'white'",
                       1000 * drawn.height, large ? 27 : 16, large ? 1.6 : 1.0);
  }
  if (output.ends_with(".pdf")) {
    return fmt::format(
        "pdfcairo size 8in,{:.3g}in font 'DejaVu Sans,{}' linewidth {} background 'white'",
        8 * drawn.height, large ? 21 : 13, large ? 1.6 : 1.0);
  }
  throw InputError(
      fmt::format("cannot draw '{}': its name must end in .png, .svg or .pdf", output));
}

PlotScript draw(const PlotRequest& request) {
  const auto traces = std::count_if(request.paths.begin(), request.paths.end(), is_trace_file);
  if (traces == 0) return draw_maps(request);
  if (traces == std::ssize(request.paths)) return draw_traces(request);
  // What is neither says so itself.
  for (const std::string& path : request.paths) {
    if (!is_trace_file(path)) ResultFile{path};
  }
  throw InputError("some of the files hold maps and some traces; draw either by themselves");
}

// Whether a picture ends as its format does: gnuplot does not always say when a disk is full.
bool is_whole(const std::string& file, const std::string& name) {
  const std::string mark = name.ends_with(".png")   ? "IEND"
                           : name.ends_with(".pdf") ? "%%EOF"
                                                    : "</svg>";
  std::ifstream in(file, std::ios::binary);
  const std::string content{std::istreambuf_iterator<char>(in), {}};
  return content.find(mark, content.size() - std::min<std::size_t>(content.size(), 32)) !=
         std::string::npos;
}

// The lines before the picture's own: where its files are and where the picture goes. Whatever
// their names and whoever starts gnuplot, they begin with '/' or './' (see plain_path()).
//
// gnuplot's default encoding passes UTF-8 on as it is, in every locale. To set any other, this one
// too, makes gnuplot 5.4 complain where the locale is not UTF-8, so that is left to whoever has
// chosen another in an own ~/.gnuplot.
std::string preamble(const fs::path& script, const std::string& output, const PlotScript& drawn) {
  const fs::path from_script = fs::absolute(output).lexically_relative(
      fs::absolute(script).lexically_normal().parent_path());
  return fmt::format(
      "# Given to gnuplot, this draws the picture again.\n"
      "plain(path) = path[1:1] eq '/' ? path : './'.path\n"
      "script = plain(ARG0)\n"
      "do for [i = 1:strlen(script)] {{ if (script[i:i] eq '/') {{ folder = script[1:i] }} }}\n"
      "files = script[1:strlen(script) - 3]\n"
      "picture = ARGC > 0 ? plain(ARG1) : folder.{}\n"
      "if (GPVAL_ENCODING ne 'default' && GPVAL_ENCODING ne 'utf8') {{ set encoding utf8 }}\n"
      "set terminal {}\n"
      "set output picture\n",
      quote(from_script.string()), terminal_of(output, drawn));
}

}  // namespace

void ensure_plottable(const std::string& output_path) {
  terminal_of(output_path, {});
  ensure_writable(output_path);
  ensure_gnuplot();
}

void plot_files(const PlotRequest& request) {
  terminal_of(request.output_path, {});
  const bool keep_script = !request.script_path.empty();
  if (keep_script && !request.script_path.ends_with(kScriptEnding)) {
    throw InputError(
        fmt::format("cannot write the script '{}': its name must end in .gp", request.script_path));
  }
  OutputFile output(request.output_path);
  if (keep_script) ensure_writable(request.script_path);
  const PlotScript drawn = draw(request);

  const TemporaryFolder folder;
  const fs::path script = keep_script ? fs::path(request.script_path) : folder.path() / "plot.gp";
  const std::string stem = script.string();
  const std::string files = stem.substr(0, stem.size() - kScriptEnding.size());
  write_file(files + ".dat", drawn.data);
  if (!drawn.missing.empty()) write_file(files + "-missing.dat", drawn.missing);
  write_file(script.string(), preamble(script, request.output_path, drawn) + drawn.text);

  run_gnuplot(script.string(), output.temporary_path());
  if (!is_whole(output.temporary_path(), request.output_path)) {
    throw RunError(fmt::format("gnuplot wrote no whole picture for '{}'; is the disk full?",
                               request.output_path));
  }
  output.commit();
}

}  // namespace gearsweep
