// gearsweep verify: whether this machine, its OpenCL driver and this build give right numbers.
#include <fmt/format.h>

#include <chrono>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/commands.hpp"
#include "cli/detail/arguments.hpp"
#include "cli/detail/signal_watch.hpp"
#include "cli/standard_streams.hpp"
#include "model/error.hpp"
#include "model/version.hpp"
#include "opencl/device.hpp"
#include "sweep/sweep.hpp"
#include "verify/verify.hpp"

namespace gearsweep {
namespace {

struct VerifyArguments {
  std::string device;
  bool as_json = false;
};

struct Timed {
  const Check* check = nullptr;
  Outcome outcome;
  double seconds = 0.0;
};

const char* word_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::pass:
      return "pass";
    case Verdict::fail:
      return "FAIL";
    case Verdict::skipped:
      break;
  }
  return "skipped";
}

Subject subject_of(const VerifyArguments& arguments, const DeviceInfo& device,
                   const SignalWatch& signals) {
  SweepOptions options;
  options.devices = chosen_devices(arguments.device);
  options.stop = &signals.interrupted();
  Subject subject;
  subject.fp64 = device.fp64;
  subject.is_cpu = device.is_cpu;
  subject.compute = [options](const Study& study) {
    std::optional<SweepResult> result = run_sweep(study, options);
    if (!result) throw RunError("interrupted");
    return *std::move(result);
  };
  return subject;
}

std::string figures_of(const Outcome& outcome) {
  if (!outcome.reason.empty()) return outcome.reason;
  const std::string count = outcome.failed > 0 ? fmt::format("{} of {} numbers are wrong",
                                                             outcome.failed, outcome.numbers)
                                               : fmt::format("{} numbers", outcome.numbers);
  return fmt::format("{}; {}", count, describe(*outcome.worst));
}

void print_line(const Timed& timed) {
  answer("{:<7}  {:<23} {:4.1f} s  {}\n", word_of(timed.outcome.verdict), timed.check->name,
         timed.seconds, figures_of(timed.outcome));
  flush_answers();
}

nlohmann::json as_json(const Timed& timed) {
  const Outcome& outcome = timed.outcome;
  nlohmann::json json = {{"name", timed.check->name},           {"what", timed.check->what},
                         {"verdict", word_of(outcome.verdict)}, {"seconds", timed.seconds},
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

Timed carry_out_timed(const Check& check, const Subject& subject) {
  const auto start = std::chrono::steady_clock::now();
  Timed timed{&check, carry_out(check, subject), 0.0};
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
  timed.seconds = spent.count();
  return timed;
}

std::size_t count(const std::vector<Timed>& all, Verdict verdict) {
  std::size_t found = 0;
  for (const Timed& timed : all) found += timed.outcome.verdict == verdict ? 1 : 0;
  return found;
}

std::string verdict_of(const std::vector<Timed>& all) {
  const std::size_t failed = count(all, Verdict::fail), skipped = count(all, Verdict::skipped);
  std::string text = failed > 0 ? fmt::format("FAIL: {} of {} checks failed", failed, all.size())
                                : fmt::format("pass: {} checks", all.size() - skipped);
  if (skipped > 0) text += fmt::format(", {} skipped", skipped);
  return text;
}

int run(const VerifyArguments& arguments, SignalWatch* signals) {
  const std::vector<DeviceInfo> devices = list_devices();
  const std::vector<DeviceChoice> chosen = chosen_devices(arguments.device);
  const DeviceInfo& device =
      devices[chosen.empty() ? default_device(devices) : chosen.front().number];
  const std::string title =
      fmt::format("{} ({}, driver {})", device.name, device.platform, device.driver);
  const Subject subject = subject_of(arguments, device, *signals);
  signals->set(OnSignal::stop);
  if (!arguments.as_json) answer("gearsweep {} on {}\n", version(), title);
  flush_answers();
  std::vector<Timed> all;
  for (const Check& check : checks()) {
    all.push_back(carry_out_timed(check, subject));
    if (signals->interrupted()) {
      tell("gearsweep: interrupted\n");
      return kInterrupted;
    }
    if (!arguments.as_json) print_line(all.back());
  }
  if (arguments.as_json) {
    nlohmann::json json = {{"device", title}, {"verdict", verdict_of(all)}};
    json["checks"] = nlohmann::json::array();
    for (const Timed& timed : all) json["checks"].push_back(as_json(timed));
    answer("{}\n", json.dump(2));
  } else {
    answer("{}\n", verdict_of(all));
  }
  return count(all, Verdict::fail) > 0 ? kFailed : kDone;
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
  command->add_flag("--json", arguments->as_json, "For scripts");
  command->footer(
      "Checks, of which each line shows the number that comes nearest its limit:\n" +
      list_of_checks() +
      "\nExamples:\n"
      "  gearsweep verify\n"
      "  gearsweep verify --device 1\n\n"
      "Exit status: 0 all checks pass, 1 one of them fails. A check in fp64 is skipped\n"
      "on a device without it.");
  command->callback([arguments, signals, status] { *status = run(*arguments, signals); });
}

}  // namespace gearsweep
