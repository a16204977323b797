#include "io/plot.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "io/gnuplot.hpp"
#include "io/output_file.hpp"
#include "io/plot_picture.hpp"
#include "io/plot_text.hpp"
#include "io/result_file.hpp"
#include "model/error.hpp"

namespace gearsweep {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPoincare = "poincare";

std::string terminal_of(const std::string& output) {
  if (output.ends_with(".png")) {
    return "pngcairo size 1400,1050 font 'DejaVu Sans,17' linewidth 1.6 background 'white'";
  }
  if (output.ends_with(".svg")) {
    return "svg size 1000,750 font 'DejaVu Sans,16' background 'white'";
  }
  if (output.ends_with(".pdf")) {
    return "pdfcairo size 8in,6in font 'DejaVu Sans,13' background 'white'";
  }
  throw InputError(
      fmt::format("cannot draw '{}': its name must end in .png, .svg or .pdf", output));
}

// Along one axis the samples, where the file has them: a bifurcation diagram. Otherwise the first
// map, else the status, which every file has.
std::string default_quantity(const ResultFile& file, bool one_axis) {
  if (one_axis && !file.poincare_states().empty()) return std::string(kPoincare);
  for (const std::string& name : file.quantities()) {
    if (name != "status" && name != kPoincare) return name;
  }
  return "status";
}

std::string chosen_quantity(const ResultFile& file, const std::string& asked, bool one_axis) {
  const std::string name = asked.empty() ? default_quantity(file, one_axis) : asked;
  if (!name.starts_with(kPoincare)) return name;
  const std::vector<std::string> states = file.poincare_states();
  if (states.empty()) return name;
  if (!one_axis) {
    throw InputError(
        fmt::format("'{}' has the axes '{}' and '{}', but a bifurcation diagram has "
                    "one; cut it at one value of either (--at {}={}), or use a "
                    "study with one axis",
                    file.path(), file.axes()[0].name, file.axes()[1].name, file.axes()[1].name,
                    file.axes()[1].values.front()));
  }
  return name == kPoincare ? fmt::format("{}:{}", kPoincare, states.front()) : name;
}

MissingPoints find_missing(const ResultMap& map, const ResultMap& status) {
  MissingPoints missing;
  const std::size_t width = map.values.size() / map.points();
  std::vector<std::size_t> reasons(status.flags.size(), 0);
  for (std::size_t point = 0; point < map.points(); ++point) {
    const auto first = map.values.begin() + static_cast<std::ptrdiff_t>(point * width);
    missing.mask.push_back(std::none_of(first, first + static_cast<std::ptrdiff_t>(width),
                                        [](double value) { return std::isfinite(value); }));
    const auto reason = static_cast<std::size_t>(status.values[point]);
    if (missing.mask.back() && reason < reasons.size()) ++reasons[reason];
  }
  std::vector<std::string> notes;
  for (std::size_t i = 0; i < reasons.size(); ++i) {
    if (reasons[i] == 0) continue;
    const std::string name = status.flags[i] == "ok" ? "undefined" : status.flags[i];
    notes.push_back(fmt::format("{} at {} of {} points", name, reasons[i], map.points()));
  }
  missing.note = fmt::format("{}", fmt::join(notes, ", "));
  return missing;
}

Picture read_picture(const PlotRequest& request) {
  const ResultFile file(request.result_path);
  std::optional<Cut> cut;
  if (request.at) {
    if (file.axes().size() < 2) {
      throw InputError(fmt::format("'{}' has one axis, '{}', so there is nothing to cut at {} = {}",
                                   file.path(), file.axes()[0].name, request.at->first,
                                   request.at->second));
    }
    cut = file.find_cut(request.at->first, request.at->second);
  }
  const bool one_axis = cut || file.axes().size() == 1;
  Picture picture;
  picture.map = file.read(chosen_quantity(file, request.quantity, one_axis), cut);
  if (!one_axis && picture.map.part_count() > 1) {
    const std::string first = picture.map.parts.front().name;
    picture.map = file.read(fmt::format("{}:{}", picture.map.name, first), cut);
  }
  picture.missing = find_missing(picture.map, file.read("status", cut));
  picture.title = file.title();
  if (cut) {
    const ResultAxis& axis = file.axes()[cut->axis];
    picture.remark = fmt::format("{} = {:.6g}", axis.name, axis.values[cut->index]);
    if (!axis.unit.empty() && axis.unit != "1") picture.remark += " " + axis.unit;
  }
  return picture;
}

PlotScript draw(const Picture& picture) {
  if (picture.map.axes.size() == 2) return draw_heat_map(picture);
  return picture.map.is_poincare() ? draw_bifurcation(picture) : draw_curve(picture);
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

// The lines before the picture's own: where its files are and where the picture goes.
std::string preamble(const fs::path& script, const std::string& output) {
  const fs::path from_script = fs::absolute(output).lexically_relative(
      fs::absolute(script).lexically_normal().parent_path());
  return fmt::format(
      "# Given to gnuplot, this draws the picture again.\n"
      "folder = ''\n"
      "do for [i = 1:strlen(ARG0)] {{ if (ARG0[i:i] eq '/') {{ folder = ARG0[1:i] }} }}\n"
      "files = ARG0[1:strlen(ARG0) - 3]\n"
      "picture = ARGC > 0 ? ARG1 : folder.{}\n"
      "set encoding utf8\n"
      "set terminal {}\n"
      "set output picture\n",
      quote(from_script.string()), terminal_of(output));
}

}  // namespace

void ensure_plottable(const std::string& output_path) {
  terminal_of(output_path);
  ensure_writable(output_path);
  run_gnuplot({"-e", "exit"});
}

void plot_map(const PlotRequest& request) {
  terminal_of(request.output_path);
  const bool keep_script = !request.script_path.empty();
  if (keep_script && !request.script_path.ends_with(".gp")) {
    throw InputError(
        fmt::format("cannot write the script '{}': its name must end in .gp", request.script_path));
  }
  OutputFile output(request.output_path);
  if (keep_script) ensure_writable(request.script_path);
  const PlotScript drawn = draw(read_picture(request));

  const TemporaryFolder folder;
  const fs::path script = keep_script ? fs::path(request.script_path) : folder.path() / "plot.gp";
  const std::string files = fs::path(script).replace_extension().string();
  write_file(files + ".dat", drawn.data);
  if (!drawn.missing.empty()) write_file(files + "-missing.dat", drawn.missing);
  write_file(script.string(), preamble(script, request.output_path) + drawn.text);

  run_gnuplot({"-c", script.string(), output.temporary_path()});
  if (!is_whole(output.temporary_path(), request.output_path)) {
    throw RunError(fmt::format("gnuplot wrote no whole picture for '{}'; is the disk full?",
                               request.output_path));
  }
  output.commit();
}

}  // namespace gearsweep
