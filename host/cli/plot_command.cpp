// gearsweep plot, gearsweep export: a result file's maps as pictures and tables.
#include <memory>

#include "cli/commands.hpp"
#include "io/export.hpp"
#include "io/plot.hpp"
#include "model/error.hpp"

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

struct ExportArguments {
  std::string result, quantity, output;
};

}  // namespace

void add_plot_command(CLI::App* app) {
  CLI::App* command = app->add_subcommand("plot", "Draw a map of a result file");
  const auto request = std::make_shared<PlotRequest>();
  const auto cut = std::make_shared<std::string>();
  command->add_option("result", request->result_path, "A result file, OUT.nc")->required();
  command->add_option(
      "-q,--quantity", request->quantity,
      "What to draw (default: the file's first); poincare:v1 picks a sampled state");
  command->add_option("-o,--output", request->output_path, "The picture: .png, .svg or .pdf")
      ->required();
  command->add_option(
      "--script", request->script_path,
      "Keep the gnuplot script (FILE.gp) and its data (FILE.dat, replaced if there)");
  command->add_option("--at", *cut, "Cut a 2-D map at the value of one axis, AXIS=VALUE");
  command->footer(
      "Examples:\n"
      "  gearsweep plot map.nc -q contact_class -o class.png\n"
      "  gearsweep plot line.nc -q poincare -o bifurcation.pdf\n"
      "  gearsweep plot map.nc -q x1_rms --at b=1 -o cut.svg --script cut.gp");
  command->callback([request, cut] {
    if (!cut->empty()) request->at = parse_cut(*cut);
    plot_map(*request);
  });
}

void add_export_command(CLI::App* app) {
  CLI::App* command = app->add_subcommand("export", "Write a map of a result file as CSV or NPY");
  const auto arguments = std::make_shared<ExportArguments>();
  command->add_option("result", arguments->result, "A result file, OUT.nc")->required();
  command->add_option("-q,--quantity", arguments->quantity, "What to write")->required();
  command->add_option("-o,--output", arguments->output, "The table: .csv or .npy")->required();
  command->footer(
      "Examples:\n"
      "  gearsweep export map.nc -q x1_rms -o rms.csv\n"
      "  gearsweep export map.nc -q x1_rms -o rms.npy\n"
      "    then in Python: m = numpy.load('rms.npy'); m['omega'], m['x1_rms']");
  command->callback(
      [arguments] { export_map(arguments->result, arguments->quantity, arguments->output); });
}

}  // namespace gearsweep
