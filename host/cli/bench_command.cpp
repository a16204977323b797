// gearsweep bench: what a machine's devices are worth to gearsweep.
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <limits>
#include <memory>
#include <optional>

#include "cli/commands.hpp"
#include "cli/detail/arguments.hpp"
#include "cli/detail/bench_report.hpp"
#include "cli/detail/signal_watch.hpp"
#include "cli/standard_streams.hpp"
#include "model/error.hpp"
#include "model/names.hpp"
#include "opencl/device.hpp"
#include "result/json_text.hpp"
#include "result/output_file.hpp"

namespace gearsweep {
namespace {

constexpr std::size_t kUsualRepetitions = 5;
constexpr double kEnoughSeconds = 6.0;  // of one benchmark, unless its repetitions are asked for

struct BenchArguments {
  std::string devices, json, only;
  std::optional<std::size_t> repetitions;
  double seconds = BenchmarkSetting{}.seconds;
};

// Tells on standard error what is measured now: on a terminal in one line, which it clears at the
// end.
class BenchProgress {
 public:
  explicit BenchProgress(std::size_t count)
      : count_(count), on_terminal_(terminal_columns(StandardStream::error).has_value()) {}
  ~BenchProgress() {
    if (on_terminal_) tell_text("\r\033[K");
  }
  BenchProgress(const BenchProgress&) = delete;
  BenchProgress& operator=(const BenchProgress&) = delete;

  void show(std::size_t device, const std::string& name) {
    const std::string text =
        fmt::format("{:2} of {}: device {}, {}", ++done_, count_, device, name);
    tell_text(on_terminal_ ? "\r" + text + "\033[K" : text + "\n");
  }

 private:
  std::size_t count_, done_ = 0;
  bool on_terminal_;
};

// Devices are measured one after the other, so each is measured whole.
std::vector<std::size_t> numbers_of(const BenchArguments& arguments,
                                    const std::vector<DeviceInfo>& devices) {
  if (arguments.devices.empty()) return {default_device(devices)};
  std::vector<std::size_t> numbers;
  for (const DeviceChoice& choice : parse_devices(arguments.devices, devices)) {
    if (choice.parts > 1) {
      throw InputError(fmt::format("--device {}: whole devices are measured; give {}",
                                   arguments.devices, choice.number));
    }
    if (std::find(numbers.begin(), numbers.end(), choice.number) == numbers.end()) {
      numbers.push_back(choice.number);
    }
  }
  return numbers;
}

bool is_below(const std::string& name, const std::string& beginning) {
  return name == beginning || name.starts_with(beginning + "/");
}

// Those that --only names.
std::vector<Benchmark> chosen_of(const std::vector<Benchmark>& all, const std::string& only) {
  if (only.empty()) return all;
  std::vector<std::string> known;
  for (const Benchmark& one : all) known.push_back(one.name);
  const std::vector<std::string> wanted = split(only, ',');
  for (const std::string& beginning : wanted) {
    if (std::none_of(known.begin(), known.end(),
                     [&](const std::string& name) { return is_below(name, beginning); })) {
      throw InputError(fmt::format(
          "--only {}: no benchmark is or begins with '{}'; there are fma, settle, record, map, "
          "start, and under them {}",
          only, beginning, fmt::join(known, ", ")));
    }
  }
  std::vector<Benchmark> chosen;
  for (const Benchmark& one : all) {
    if (std::any_of(wanted.begin(), wanted.end(),
                    [&](const std::string& beginning) { return is_below(one.name, beginning); })) {
      chosen.push_back(one);
    }
  }
  return chosen;
}

// Throws InputError where the file could not be written, or is something else that would be lost.
void ensure_json_path(const std::string& path) {
  ensure_writable(path);
  std::ifstream in(path);
  char first = '{';
  if (in >> first && first != '{') {
    throw InputError(fmt::format(
        "--json {}: exists and is no JSON file; it would be lost: give another FILE", path));
  }
}

void warn_of_load(const Machine& machine) {
  if (!machine.is_busy()) return;
  tell(
      "gearsweep: warning: the machine is busy: its load average is {:.2f} on {} cores, so what "
      "is measured may be too slow; wait until it is below {:.2f}\n",
      machine.load, machine.cores, machine.quiet_load());
}

// Nothing when it was interrupted.
std::optional<std::vector<BenchedDevice>> measure(const BenchArguments& arguments,
                                                  const SignalWatch& signals) {
  const std::vector<DeviceInfo> devices = list_devices();
  std::vector<BenchedDevice> benched;
  std::vector<std::vector<Benchmark>> benchmarks;
  std::size_t count = 0;
  for (const std::size_t number : numbers_of(arguments, devices)) {
    const BenchmarkSetting setting = {number, arguments.seconds, "/proc/self/exe",
                                      &signals.interrupted()};
    benched.push_back({number, devices[number], {}});
    benchmarks.push_back(chosen_of(benchmarks_of(devices[number], setting), arguments.only));
    count += benchmarks.back().size();
  }
  BenchProgress progress(count);
  const std::size_t repetitions = arguments.repetitions.value_or(kUsualRepetitions);
  const double enough =
      arguments.repetitions ? std::numeric_limits<double>::infinity() : kEnoughSeconds;
  for (std::size_t i = 0; i < benched.size(); ++i) {
    for (const Benchmark& one : benchmarks[i]) {
      progress.show(benched[i].number, one.name);
      benched[i].rows.push_back(carry_out(one, repetitions, enough, signals.interrupted()));
      if (signals.interrupted()) return std::nullopt;
    }
  }
  return benched;
}

// The date, as in 2026-01-31T12:00:00+01:00.
std::string date_of_now() {
  const std::string text =
      fmt::format("{:%Y-%m-%dT%H:%M:%S%z}", fmt::localtime(std::time(nullptr)));
  return text.substr(0, text.size() - 2) + ":" + text.substr(text.size() - 2);
}

int run(const BenchArguments& arguments, SignalWatch* signals) {
  if (!arguments.json.empty()) ensure_json_path(arguments.json);
  const std::string date = date_of_now();
  const Machine machine = this_machine();
  warn_of_load(machine);
  signals->set(OnSignal::stop);
  const std::optional<std::vector<BenchedDevice>> benched = measure(arguments, *signals);
  if (!benched) return tell_interrupted();
  if (!arguments.json.empty()) {
    write_file(arguments.json, json_text(bench_json(machine, *benched, date)));
  }
  answer("{}", bench_table(machine, *benched));
  for (const BenchedDevice& device : *benched) {
    for (const BenchmarkRow& row : device.rows) {
      if (row.failed) return kFailed;
    }
  }
  return kDone;
}

}  // namespace

void add_bench_command(CLI::App* app, SignalWatch* signals, int* status) {
  CLI::App* command =
      app->add_subcommand("bench", "Measure how fast this machine's devices are, in a minute");
  const auto arguments = std::make_shared<BenchArguments>();
  add_device_option(command, &arguments->devices, kDevicesValue,
                    "Numbers of 'gearsweep devices' to measure one after the other: 0,1 or all "
                    "(default: the one that a run uses)");
  command
      ->add_option("--json", arguments->json,
                   "Also write the numbers to a file, in Google Benchmark's format")
      ->type_name(kFileValue)
      ->check([](const std::string& path) { return path.empty() ? "must not be empty" : ""; });
  command
      ->add_option("--only", arguments->only,
                   "Only the benchmarks of these names, or that lie under them: fma,settle/fp64")
      ->type_name("NAME,...")
      ->check([](const std::string& names) { return names.empty() ? "must not be empty" : ""; });
  command
      ->add_option(
          "--repetitions", arguments->repetitions,
          fmt::format("Measure each so many times (default: {}, fewer of what takes longer "
                      "than {:.0f} s)",
                      kUsualRepetitions, kEnoughSeconds))
      ->type_name(kNumberValue)
      ->check(whole_number(1, 1000));
  command
      ->add_option("--seconds", arguments->seconds,
                   fmt::format("Of each repetition of a kernel (default: {})", arguments->seconds))
      ->type_name(kNumberValue)
      ->check(positive_number());
  command->footer(
      "Rows of the table:\n"
      "  fma/...           fused multiply-adds, two operations each: the peak\n"
      "  settle/...        the kernel that lets motions settle; lanes:N with N points per\n"
      "                    work-item, otherwise what suits the device\n"
      "  record/...        the kernel that records: six maps, or Lyapunov exponents\n"
      "  map/...           coarse-map on 160 x 120 points, with points that stop on orbits and\n"
      "                    without\n"
      "  start/...         from the start of the program to the file of 64 points; cold: with no\n"
      "                    kernel built before\n"
      "Numbers are medians; the spread is the largest less the smallest, over the median.\n"
      "\n"
      "Examples:\n"
      "  gearsweep bench\n"
      "  gearsweep bench --device all --json here.json\n"
      "  gearsweep bench --only settle,record --repetitions 20\n"
      "  compare.py benchmarks here.json there.json    of Google Benchmark, two machines\n"
      "\n"
      "Exit status: 0 done, 1 a benchmark failed. Those in fp64 are skipped on a device without\n"
      "it.");
  command->callback([arguments, signals, status] { *status = run(*arguments, signals); });
}

}  // namespace gearsweep
