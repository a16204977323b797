// gearsweep verify: whether this machine, its OpenCL driver and this build give right numbers.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/commands.hpp"
#include "cli/detail/answer_check.hpp"
#include "cli/detail/arguments.hpp"
#include "cli/detail/named_model.hpp"
#include "cli/detail/signal_watch.hpp"
#include "cli/detail/stop_on_signals.hpp"
#include "cli/standard_streams.hpp"
#include "model/version.hpp"
#include "opencl/device.hpp"
#include "result/json_text.hpp"
#include "study/builtin_models.hpp"
#include "verify/verify.hpp"

namespace gearsweep {
namespace {

struct VerifyArguments {
  std::string device, model;
  bool of_zoo = false, as_json = false;
};

// Those whose known answers are asked for, in place of the checks.
std::vector<NamedModel> asked_models(const VerifyArguments& arguments) {
  if (!arguments.model.empty()) return {named_model(arguments.model)};
  std::vector<NamedModel> all;
  if (!arguments.of_zoo) return all;
  for (const std::string& name : model_names()) all.push_back(named_model(name));
  return all;
}

void print_line(const CheckReport& report) {
  answer("{:<7}  {:<23} {:4.1f} s  {}\n", word_of(report.outcome.verdict), report.check->name,
         report.seconds, figures_of(report.outcome));
  flush_answers();
}

nlohmann::json as_json(const CheckReport& report) {
  const Outcome& outcome = report.outcome;
  nlohmann::json json = {{"name", report.check->name},          {"what", report.check->what},
                         {"verdict", word_of(outcome.verdict)}, {"seconds", report.seconds},
                         {"numbers", outcome.numbers},          {"failed", outcome.failed}};
  if (!outcome.reason.empty()) json["reason"] = outcome.reason;
  if (outcome.worst) {
    json["worst"] = {{"what", outcome.worst->what},
                     {"expected", outcome.worst->expected},
                     {"seen", outcome.worst->seen},
                     {"tolerance", outcome.worst->tolerance}};
  }
  return json;
}

int run(const VerifyArguments& arguments, SignalWatch* signals) {
  const std::vector<NamedModel> models = asked_models(arguments);
  const std::vector<DeviceInfo> devices = list_devices();
  const std::vector<DeviceChoice> chosen = chosen_devices(arguments.device);
  const DeviceInfo& device =
      devices[chosen.empty() ? default_device(devices) : chosen.front().number];
  const std::string title =
      fmt::format("{} ({}, driver {})", device.name, device.platform, device.driver);
  SweepOptions options;
  options.devices = chosen;
  options.stop = stop_on_signals(signals, arguments.as_json, options.scheduler);
  const Subject subject = make_subject(device, options);
  if (!arguments.as_json) answer("gearsweep {} on {}\n", version(), title);
  flush_answers();
  if (!models.empty()) return check_answers(models, subject, title, arguments.as_json, signals);
  std::vector<CheckReport> all;
  for (const Check& check : checks()) {
    all.push_back(carry_out_timed(check, subject));
    if (signals->interrupted()) return tell_interrupted();
    if (!arguments.as_json) print_line(all.back());
  }
  if (arguments.as_json) {
    nlohmann::json json = {{"device", title}, {"verdict", verdict_of(all)}};
    json["checks"] = nlohmann::json::array();
    for (const CheckReport& report : all) json["checks"].push_back(as_json(report));
    answer("{}", json_text(json));
  } else {
    answer("{}\n", verdict_of(all));
  }
  const bool has_failed = std::any_of(all.begin(), all.end(), [](const CheckReport& report) {
    return report.outcome.verdict == Verdict::fail;
  });
  return has_failed ? kFailed : kDone;
}

std::string list_of_checks() {
  std::string text;
  for (const Check& check : checks()) text += fmt::format("  {:<24} {}\n", check.name, check.what);
  return text;
}

}  // namespace

void add_verify_command(CLI::App* app, SignalWatch* signals, int* status) {
  CLI::App* command = app->add_subcommand(
      "verify", "Check that this machine and its OpenCL driver give right numbers");
  const auto arguments = std::make_shared<VerifyArguments>();
  add_device_option(command, &arguments->device, false);
  CLI::Option* zoo = command->add_flag("--zoo", arguments->of_zoo,
                                       "The known answers of all built-in models instead");
  command
      ->add_option("--model", arguments->model,
                   "Those of one model: a built-in one, or a file of your own")
      ->type_name(kModelValue)
      ->excludes(zoo);
  command->add_flag("--json", arguments->as_json, "For scripts");
  command->footer(
      "Checks, of which each line shows the number that comes nearest its limit:\n" +
      list_of_checks() +
      "\nExamples:\n"
      "  gearsweep verify\n"
      "  gearsweep verify --device 1\n"
      "  gearsweep verify --zoo                what published models must give\n"
      "  gearsweep verify --model mine.toml    what its [[answers]] say\n\n"
      "Exit status: 0 all checks pass, 1 one of them fails. A check in fp64 is skipped\n"
      "on a device without it.");
  command->callback([arguments, signals, status] { *status = run(*arguments, signals); });
}

}  // namespace gearsweep
