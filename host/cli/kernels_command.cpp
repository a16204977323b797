// gearsweep kernels: the program that a study's device runs.
#include <fmt/format.h>

#include <memory>

#include "cli/commands.hpp"
#include "cli/detail/arguments.hpp"
#include "cli/detail/study_source.hpp"
#include "cli/standard_streams.hpp"
#include "opencl/program_source.hpp"
#include "plan/passive_states.hpp"

namespace gearsweep {
namespace {

struct KernelsArguments {
  std::string study;
  std::string program = "sweep";
  std::vector<std::string> overrides;
};

void print_program(const KernelsArguments& arguments) {
  const Study whole = load_study(arguments.study, arguments.overrides);
  // A trace keeps every state.
  const Study study = arguments.program == "trace" ? whole : without_passive_states(whole);
  // How many points a work-item takes is the device's choice unless the study makes it.
  const std::size_t lanes = study.integrate.lanes > 0 ? study.integrate.lanes : 1;
  answer("// OpenCL C, built with\n//   {}\n", build_options(study, lanes));
  if (study.integrate.lanes == 0) answer("// where the device chooses LANES: this is for 1.\n");
  answer("{}", program_source(study, arguments.program + ".cl"));
}

}  // namespace

void add_kernels_command(CLI::App* app) {
  CLI::App* command = app->add_subcommand(
      "kernels", "Print the OpenCL program that is written for a study, whole and readable");
  const auto arguments = std::make_shared<KernelsArguments>();
  add_study_argument(command, &arguments->study);
  add_set_option(command, &arguments->overrides);
  add_choice(command, "--program", &arguments->program, {"sweep", "orbit", "trace"},
             "Which: it settles and records, looks for periodic orbits, or keeps every state of a "
             "trace (default: sweep)");
  command->footer(
      "#line tells where each part comes from; kernels/selection.h and kernels/observers.h are\n"
      "written for the study.\n"
      "\n"
      "Examples:\n"
      "  gearsweep kernels coarse-map\n"
      "  gearsweep kernels mine.toml --set integrate.precision=fp32 > mine.cl\n"
      "  gearsweep kernels map.nc --program orbit");
  command->callback([arguments] { print_program(*arguments); });
}

}  // namespace gearsweep
