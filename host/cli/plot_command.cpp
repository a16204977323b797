// gearsweep plot, gearsweep export: maps and traces as pictures, maps as tables.
#include <fmt/format.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "cli/commands.hpp"
#include "cli/detail/arguments.hpp"
#include "model/error.hpp"
#include "model/names.hpp"
#include "plot/plot.hpp"
#include "result/broken_file.hpp"
#include "result/export.hpp"

namespace gearsweep {
namespace {

// "b=1" as a pair.
std::pair<std::string, double> parse_cut(const std::string& text) {
  const std::size_t equals = text.find('=');
  try {
    std::size_t used = 0;
    const std::string number = text.substr(equals == std::string::npos ? text.size() : equals + 1);
    const double value = std::stod(number, &used);
    if (equals > 0 && used == number.size()) return {text.substr(0, equals), value};
  } catch (const std::exception&) {
    // Falls through to the one message for all malformed cuts.
  }
  throw InputError("--at " + text + ": expected AXIS=VALUE, as in b=1");
}

// The style options that are given, by their names, in the order of the command line's table.
using StyleArguments = std::map<std::string, std::string>;

void add_style_options(CLI::App* command, StyleArguments* given, std::string* file) {
  command
      ->add_option("--style", *file,
                   "A TOML file whose keys are the options from --size on; the command line wins")
      ->type_name(kFileValue);
  for (const StyleOption& option : style_options()) {
    const auto keep = [given, name = option.name](const std::string& text) {
      (*given)[name] = text;
    };
    const std::string dashed = "--" + option.name;
    if (option.value.empty()) {
      command->add_flag_callback(
          dashed, [keep] { keep("true"); }, option.meaning);
    } else {
      command->add_option_function<std::string>(dashed, keep, option.meaning)
          ->type_name(option.value)
          ->expected(1);
    }
  }
}

PlotStyle style_of(const StyleArguments& given, const std::string& file) {
  PlotStyle style;
  if (!file.empty()) read_style_file(file, &style);
  for (const StyleOption& option : style_options()) {
    const auto found = given.find(option.name);
    if (found == given.end()) continue;
    try {
      style.demanded.insert(option.name);
      option.set(option.is_list ? split(found->second, ',') : std::vector{found->second}, &style);
    } catch (const InputError& error) {
      throw InputError(fmt::format("--{}: {}", option.name, error.what()));
    }
  }
  return style;
}

struct ExportArguments {
  std::string result, quantities, output;
  TableUnits units = TableUnits::model;
};

constexpr const char* kPlotFooter =
    "Examples:\n"
    "  gearsweep plot map.nc -q contact_class -o class.png\n"
    "  gearsweep plot map.nc -o figure.pdf --width 85mm --title '' --colormap cividis\n"
    "  gearsweep plot map.nc -o figure.tex --style thesis.toml --range 0:2\n"
    "  gearsweep plot map.nc --curves curves.nc -q period -o borders.pdf\n"
    "  gearsweep plot line.nc -q poincare,x1_rms,dmf_max -o stack.pdf\n"
    "  gearsweep plot line.nc other.nc -q x1_rms -o both.png\n"
    "  gearsweep plot map.nc -q x1_rms --at e0=0.3 -o cut.svg --script cut.gp\n"
    "  gearsweep plot trace.nc -q force -o force.png\n"
    "  gearsweep plot trace.nc -q portrait:x3 -o portrait.pdf --width 170mm\n"
    "  gearsweep plot trace.nc frictionless.nc -q phase -o phase.png";

// What only some kinds of files have: traces, order maps, maps of two axes.
void add_kind_options(CLI::App* command, PlotRequest* request) {
  command
      ->add_option("--periods", request->periods,
                   "Of traces, at most so many last periods (default: 10 in time and force, else "
                   "all; of a portrait those of its histories; a spectrum separates subharmonics "
                   "best over a multiple of their period)")
      ->type_name(kNumberValue)
      ->check(whole_number(1));
  command
      ->add_option("--orders", request->orders,
                   "The highest order of a spectrum (default: 10). It is of whole periods with "
                   "Hann's window, without the mean, and shows the amplitudes of sines")
      ->type_name(kNumberValue)
      ->check(positive_number());
  command
      ->add_option("--rays", request->rays,
                   "Orders that an order map has as lines: 1,2,1/2, of a second mesh 1:second, or "
                   "none (default: 1,2,3,4 of each)")
      ->type_name("N,N/N,...");
  command
      ->add_option("--curves", request->curves_path,
                   "Bifurcation curves that gearsweep curves found, drawn over a map of two axes")
      ->type_name(kResultValue);
}

}  // namespace

void add_plot_command(CLI::App* app) {
  CLI::App* command = app->add_subcommand("plot", "Draw maps of result files, or traces");
  const auto request = std::make_shared<PlotRequest>();
  const auto cut = std::make_shared<std::string>();
  const auto style_file = std::make_shared<std::string>();
  const auto style = std::make_shared<StyleArguments>();
  command
      ->add_option("file", request->paths,
                   "A result file or a file of traces; several are laid over one another (result "
                   "files over one axis)")
      ->type_name(kResultValue)
      ->required();
  command
      ->add_option(
          "-q,--quantity", request->quantity,
          "What to draw. Of maps (default: the file's first): poincare:v1 picks a sampled state; "
          "over one axis several, NAME,NAME, stand above one another. Of traces: time (the "
          "default), phase, section, spectrum, force or portrait (four of them in one picture); "
          "time:v3, phase:x3, phase:x1:x3, spectrum:dmf, portrait:x3 pick channels (default: the "
          "first state; force: that between the teeth). Of an order map: frequency (the default) "
          "or order, over the "
          "axis")
      ->type_name(kQuantityValue);
  command
      ->add_option("-o,--output", request->output_path,
                   "The picture: .png, .svg, .pdf or .tex (LaTeX; with a .pdf beside it)")
      ->type_name(kFileValue)
      ->required();
  command
      ->add_option(
          "--script", request->script_path,
          "Keep the gnuplot script (FILE.gp) and its data (FILE.dat, replaced if there), to "
          "restyle: gnuplot -c FILE.gp [PICTURE [DATA]]")
      ->type_name(kFileValue);
  command->add_option("--at", *cut, "Cut a 2-D map at the value of one axis")
      ->type_name("AXIS=VALUE");
  add_kind_options(command, request.get());
  add_style_options(command, style.get(), style_file.get());
  command->footer(kPlotFooter);
  command->callback([request, cut, style, style_file] {
    if (!cut->empty()) request->at = parse_cut(*cut);
    request->style = style_of(*style, *style_file);
    for (const std::string& path : request->paths) ensure_not_broken(path);
    if (!request->curves_path.empty()) ensure_not_broken(request->curves_path);
    plot_files(*request);
  });
}

void add_export_command(CLI::App* app) {
  CLI::App* command = app->add_subcommand("export", "Write maps of a result file as CSV or NPY");
  const auto arguments = std::make_shared<ExportArguments>();
  command->add_option("result", arguments->result, "A result file")
      ->type_name(kResultValue)
      ->required();
  command
      ->add_option("-q,--quantity", arguments->quantities,
                   "What to write; several, NAME,NAME, stand beside each other (default: all but "
                   "poincare, which has a row for each sample)")
      ->type_name(kQuantityValue);
  command->add_option("-o,--output", arguments->output, "The table: .csv or .npy")
      ->type_name(kFileValue)
      ->required();
  add_units_option(command, &arguments->units);
  command->footer(
      "Examples:\n"
      "  gearsweep export map.nc -q x1_rms -o rms.csv\n"
      "  gearsweep export map.nc -q x1_rms,dmf_max -o both.csv\n"
      "  gearsweep export map.nc -o all.csv\n"
      "  gearsweep export map.nc -q x1_rms -o rms.npy\n"
      "    then in Python: m = numpy.load('rms.npy'); m['omega'], m['x1_rms']");
  command->callback([arguments] {
    ensure_not_broken(arguments->result);
    std::vector<std::string> quantities;
    if (!arguments->quantities.empty()) quantities = split(arguments->quantities, ',');
    export_maps(arguments->result, quantities, arguments->output, arguments->units);
  });
}

}  // namespace gearsweep
