// gearsweep floquet: the periodic orbit or the equilibrium at one point of a study, its Floquet
// multipliers or eigenvalues, and the bifurcations along a parameter.
#include <fmt/format.h>

#include <chrono>
#include <functional>
#include <memory>

#include "cli/commands.hpp"
#include "cli/detail/arguments.hpp"
#include "cli/detail/floquet_report.hpp"
#include "cli/detail/place_text.hpp"
#include "cli/detail/stop_on_signals.hpp"
#include "cli/detail/study_source.hpp"
#include "cli/standard_streams.hpp"
#include "point/point_orbit.hpp"
#include "point/point_trace.hpp"
#include "result/result_file.hpp"

namespace gearsweep {
namespace {

struct FloquetArguments {
  std::string study, along;
  std::vector<std::string> at, overrides;
  std::string device;
  std::optional<std::size_t> period, steps;
  std::size_t generations = 0;
  bool is_equilibrium = false, as_json = false;
};

// A line every ten seconds, in which the branch has come further.
std::function<void(const Branch&)> tell_branch(const std::string& parameter) {
  using Clock = std::chrono::steady_clock;
  return [parameter, last = Clock::now()](const Branch& branch) mutable {
    if (Clock::now() - last < std::chrono::seconds(10)) return;
    last = Clock::now();
    tell("{} orbits, to {} = {:.8g}\n", branch.orbits.size(), parameter,
         branch.orbits.back().parameter);
  };
}

OrbitFindings compute(const FloquetArguments& arguments) {
  Study whole = load_study(arguments.study, arguments.overrides);
  settle_step(is_netcdf(arguments.study) ? read_pilot_step(arguments.study) : std::nullopt, &whole);
  OrbitRequest request = {.place = {},
                          .range = {},
                          .range_origin = "--along",
                          .period = arguments.period,
                          .steps = arguments.steps,
                          .is_equilibrium = arguments.is_equilibrium,
                          .generations = arguments.generations};
  if (!arguments.along.empty()) {
    request.range = read_range(*whole.model, arguments.along);
    request.each_orbit = tell_branch(whole.model->parameters[request.range->parameter].name);
  }
  request.place = read_place(whole, arguments.at);
  SweepOptions options;
  options.devices = chosen_devices(arguments.device);
  tell_long_compiles(options.scheduler.get(), arguments.as_json);
  return *find_point_orbit(whole, request, options);
}

void add_follow_options(CLI::App* command, FloquetArguments* arguments) {
  CLI::Option* const along =
      command
          ->add_option("--along", arguments->along,
                       "Follow the orbit and locate its bifurcations; starts where --at says, or "
                       "else at FROM")
          ->type_name("NAME=FROM:TO");
  command
      ->add_option("--switch", arguments->generations,
                   "With --along: follow also what leaves at flips and where branches cross (a "
                   "symmetry breaks), what leaves those branches, and so on, N times (default: 0)")
      ->type_name(kNumberValue)
      ->check(whole_number(0, 12))
      ->needs(along);
}

}  // namespace

void add_floquet_command(CLI::App* app) {
  CLI::App* command = app->add_subcommand(
      "floquet", "The orbit or the equilibrium at a point, its multipliers, and its bifurcations");
  const auto arguments = std::make_shared<FloquetArguments>();
  add_study_argument(command, &arguments->study);
  add_point_option(command, &arguments->at,
                   "Where to look: a value for each axis of the study, and for other parameters; "
                   "taken as it is, also between the points of a map")
      ->delimiter(',');
  add_follow_options(command, arguments.get());
  command
      ->add_option("--period", arguments->period,
                   "The orbit's length in forcing periods; where nothing drives the model, in "
                   "returns to its first section, or to where the first state is largest (default: "
                   "the smallest after which the motion repeats, 64 at most)")
      ->type_name(kNumberValue)
      ->check(whole_number(1, 4096));
  command
      ->add_option(
          "--steps", arguments->steps,
          fmt::format("Integration steps per period, or from a return to the next (default: "
                      "{} or the study's, if that is more)",
                      kMinOrbitSteps))
      ->type_name(kNumberValue)
      ->check(whole_number(16, 65536));
  add_device_option(command, &arguments->device, false);
  add_set_option(command, &arguments->overrides);
  command
      ->add_flag(
          "--equilibrium", arguments->is_equilibrium,
          "The equilibrium that Newton's method comes to from the start, stable or not, of a "
          "model that nothing drives")
      ->excludes("--period");
  command->add_flag("--json", arguments->as_json, "For scripts, with every orbit on the way");
  command->footer(
      "Examples:\n"
      "  gearsweep floquet coarse-map --at omega=0.7,e0=0.5\n"
      "  gearsweep floquet coarse-map --at omega=0.7,e0=0.5 --along omega=0.6:0.8\n"
      "  gearsweep floquet coarse-map --at omega=0.55,e0=0.6 --period 1   an orbit inside chaos\n"
      "  gearsweep floquet pendulum-cascade --along damping=0.75:0.72 --switch 3   to period 8\n\n"
      "  gearsweep floquet my-brusselator --at b=2.5 --along b=2.5:1.8   a cycle, to its birth\n"
      "  gearsweep floquet my-lorenz --at x=8,y=8,z=20 --equilibrium --along rho=20:28\n\n"
      "The engine settles the motion; Newton's method on the period map finds the orbit. Where\n"
      "nothing drives the model it is an equilibrium, or a cycle whose time is found, too. Steps\n"
      "end where teeth meet or part. The digits shown are those that steps of twice the length\n"
      "agree on.");
  command->callback([arguments] {
    const OrbitFindings findings = compute(*arguments);
    answer("{}", arguments->as_json ? floquet_as_json(findings) : describe_floquet(findings));
  });
}

}  // namespace gearsweep
