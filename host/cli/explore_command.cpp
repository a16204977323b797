// gearsweep explore: a page to walk around in a map.
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <memory>

#include "cli/commands.hpp"
#include "cli/detail/arguments.hpp"
#include "cli/detail/browser.hpp"
#include "cli/detail/named_model.hpp"
#include "cli/detail/stop_on_signals.hpp"
#include "cli/detail/study_source.hpp"
#include "cli/standard_streams.hpp"
#include "explore/explored_curves.hpp"
#include "explore/result_data.hpp"
#include "explore/server.hpp"
#include "model/error.hpp"
#include "result/broken_file.hpp"
#include "result/result_file.hpp"
#include "result/study_source.hpp"
#include "study/builtin_models.hpp"
#include "study/draft.hpp"
#include "study/model_file.hpp"
#include "sweep/pilot.hpp"

namespace gearsweep {
namespace {

struct ExploreArguments {
  std::string study, curves, device;
  std::vector<std::string> overrides;
  std::size_t port = 0, megabytes = 512;
  bool opens_browser = true, quiet = false;
};

// A model's file has equations, which no study has.
bool names_model(const std::string& name_or_path) {
  if (name_or_path.find_first_of("./") == std::string::npos) {
    const std::vector<std::string> studies = builtin_study_names();
    return std::ranges::find(studies, name_or_path) == studies.end() &&
           find_model(name_or_path) != nullptr;
  }
  return !is_netcdf(name_or_path) &&
         ("\n" + model_file_text(name_or_path)).find("\n[equations]") != std::string::npos;
}

Study load(const ExploreArguments& arguments, bool is_model) {
  if (!is_model) return load_study(arguments.study, arguments.overrides);
  const NamedModel named = named_model(arguments.study);
  const std::string text = fmt::format(
      "[model]\n{}\n[observe]\nquantities = ['motion_class', 'period', 'lyapunov_max', '{}_max']\n",
      named.key, named.model->states.front().name);
  // Its path is from here, not from the folder of a study.
  return read_draft(text, "explore", arguments.overrides);
}

// The step that the map had, or that a tolerance asks for; nothing: the model's or the study's own.
std::optional<FoundStep> step_of(const ExploreArguments& arguments, const Study& study,
                                 const SweepOptions& options) {
  if (is_netcdf(arguments.study)) return read_pilot_step(arguments.study);
  if (!study.integrate.is_tolerance_asked) return std::nullopt;
  const std::optional<SteppedStudy> stepped = choose_step(study, options);
  return stepped && stepped->pilot ? std::optional(stepped->pilot->step) : std::nullopt;
}

// What a link needs to work again with a server that was started anew. Not an option, which other
// users of the machine could read.
std::string token_of_environment() {
  constexpr const char* kVariable = "GEARSWEEP_EXPLORE_TOKEN";
  constexpr std::size_t kMinLength = 16;
  const char* given = std::getenv(kVariable);
  const std::string token = given == nullptr ? "" : given;
  const bool is_plain = token.find_first_not_of(
                            "0123456789abcdefghijklmnopqrstuvwxyz"
                            "ABCDEFGHIJKLMNOPQRSTUVWXYZ") == std::string::npos;
  if (token.empty() || (is_plain && token.size() >= kMinLength)) return token;
  throw InputError(
      fmt::format("{} takes {} or more letters and digits, such as those that 'openssl rand -hex "
                  "16' prints",
                  kVariable, kMinLength));
}

int run(const ExploreArguments& arguments, SignalWatch* signals) {
  const std::string token = token_of_environment();
  const bool is_model = names_model(arguments.study);
  const Study whole = load(arguments, is_model);
  const Study study = explorable(whole);
  ExplorerOptions options;
  options.source = shell_quoted(arguments.study);
  options.is_model = is_model;
  for (const std::string& set : arguments.overrides)
    options.source += " --set " + shell_quoted(set);
  options.devices = chosen_devices(arguments.device);
  options.max_bytes = arguments.megabytes << 20U;
  SweepOptions sweep;
  sweep.devices = options.devices;
  // Other values than the file's have no numbers there.
  if (is_netcdf(arguments.study) && arguments.overrides.empty()) {
    options.data = read_result_data(arguments.study, study);
  }
  if (!arguments.curves.empty()) {
    ensure_not_broken(arguments.curves);
    options.curves = read_explored_curves(arguments.curves, study);
  }
  const ExploredStudy base = {study, step_of(arguments, study, sweep), whole.axes.size() == 1};
  Explorer explorer(base, options);
  ExploreServer server(&explorer, static_cast<int>(arguments.port), token);
  signals->set(OnSignal::stop);
  answer("{}\n", server.address());
  flush_answers();
  if (!arguments.quiet) tell("open it in a browser; Ctrl-C ends it\n");
  if (arguments.opens_browser) open_browser(server.address());
  server.serve(signals->interrupted());
  return kDone;
}

}  // namespace

void add_explore_command(CLI::App* app, SignalWatch* signals, int* status) {
  CLI::App* command = app->add_subcommand("explore", "Walk around in a map, in a browser");
  const auto arguments = std::make_shared<ExploreArguments>();
  add_study_argument(command, &arguments->study, ", whose step is taken");
  command
      ->add_option("--curves", arguments->curves,
                   "Bifurcation curves that gearsweep curves found, drawn over the map")
      ->type_name(kResultValue);
  command
      ->add_option("--port", arguments->port,
                   "A port of this machine's own address (default: any that is free)")
      ->type_name(kNumberValue)
      ->check(whole_number(1, 65535));
  command
      ->add_option("--memory", arguments->megabytes,
                   "Megabytes of computed tiles that are kept (default: 512)")
      ->type_name(kNumberValue)
      ->check(whole_number(16, 1 << 20));
  command->add_flag("!--no-browser", arguments->opens_browser, "Only print the address");
  add_device_option(command, &arguments->device, true);
  add_set_option(command, &arguments->overrides);
  command->add_flag("--quiet", arguments->quiet, "Print the address alone");
  command->footer(
      "Examples:\n"
      "  gearsweep explore coarse-chaos\n"
      "  gearsweep explore map.nc                   with the step of that map\n"
      "  gearsweep explore map.nc --curves curves.nc\n"
      "  gearsweep explore my-model.toml            a model's file: two of its parameters\n"
      "  gearsweep explore mine.toml --set parameters.mu=0 --no-browser --port 8000\n\n"
      "The page computes what it shows: zooming gives the map anew at the new resolution, a click\n"
      "the motion at that point, a slider another parameter. A study with one axis gets a second "
      "one. The address\n"
      "has a token and is of this machine alone; who has it can compute here.");
  command->callback([arguments, signals, status] { *status = run(*arguments, signals); });
}

}  // namespace gearsweep
