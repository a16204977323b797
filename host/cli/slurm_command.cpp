// gearsweep slurm: the job array of a study, for Slurm.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <memory>

#include "cli/commands.hpp"
#include "cli/detail/arguments.hpp"
#include "cli/standard_streams.hpp"
#include "model/error.hpp"
#include "result/study_source.hpp"
#include "scheduler/shard.hpp"
#include "sweep/run_context.hpp"

namespace gearsweep {
namespace {

constexpr std::size_t kMostJobs = 100000;

struct SlurmArguments {
  std::string study, output = "map.nc", time = "01:00:00", devices;
  std::vector<std::string> overrides;
  std::size_t jobs = 0;
  std::size_t cores = 4;
};

// The run of one shard, as the script has it.
std::string run_of(const SlurmArguments& arguments, const Study& study) {
  std::string line = fmt::format("gearsweep run {} -o {}", shell_quoted(arguments.study),
                                 shell_quoted(arguments.output));
  if (!arguments.devices.empty()) line += " --device " + shell_quoted(arguments.devices);
  for (const std::string& one : arguments.overrides) line += " --set " + shell_quoted(one);
  if (study.integrate.tile == 0) {
    line += fmt::format(" --set integrate.tile={}",
                        tile_for_shards(study.trajectories(), arguments.jobs));
  }
  return line + fmt::format(" --quiet --shard \"$SLURM_ARRAY_TASK_ID/{}\"", arguments.jobs);
}

std::string script_of(const SlurmArguments& arguments, const Study& study) {
  const std::string name = std::filesystem::path(arguments.output).stem().string();
  return fmt::format(
      R"(#!/bin/bash
#SBATCH --job-name={name}
#SBATCH --array=1-{jobs}
#SBATCH --cpus-per-task={cores}
#SBATCH --time={time}
#SBATCH --requeue
#SBATCH --open-mode=append
#SBATCH --output={name}-%a.log
#SBATCH --signal=B:USR1@120
#
# Each job computes one of {jobs} shards. A job that is preempted or runs out of time begins again, and
# goes on from the tiles that its shard's journal keeps.
#
#   sbatch THIS_FILE                                    begins them
#   gearsweep status {output}                           tells how far they are
#   gearsweep merge {output}.shard-*.journal -o {output}      puts them together
go_on_later() {{
  kill -TERM "$run" 2> /dev/null
  wait "$run"
  scontrol requeue "${{SLURM_ARRAY_JOB_ID}}_${{SLURM_ARRAY_TASK_ID}}"
  exit 0
}}
trap go_on_later USR1
{run} &
run=$!
wait "$run"
)",
      fmt::arg("name", shell_quoted(name)), fmt::arg("jobs", arguments.jobs),
      fmt::arg("cores", arguments.cores), fmt::arg("time", arguments.time),
      fmt::arg("output", shell_quoted(arguments.output)),
      fmt::arg("run", run_of(arguments, study)));
}

void print_script(const SlurmArguments& arguments) {
  require_result_path(arguments.output);
  // It stands in comments of the script, which end where a line does.
  if (std::ranges::any_of(arguments.output, [](unsigned char c) { return std::iscntrl(c) != 0; })) {
    throw InputError("-o: a name of a file with control characters or line breaks; give another");
  }
  const Study study = find_study(arguments.study, arguments.overrides);
  if (const std::string wrong = why_no_shards(study); !wrong.empty()) {
    throw InputError(fmt::format("{}: {}", arguments.study, wrong));
  }
  if (arguments.jobs > study.trajectories()) {
    throw InputError(fmt::format("--jobs {}: the study has {} trajectories; give at most so many",
                                 arguments.jobs, study.trajectories()));
  }
  answer("{}", script_of(arguments, study));
}

}  // namespace

void add_slurm_command(CLI::App* app) {
  CLI::App* command =
      app->add_subcommand("slurm", "Print a job array that runs a study on a cluster");
  const auto arguments = std::make_shared<SlurmArguments>();
  add_study_argument(command, &arguments->study);
  command->add_option("--jobs", arguments->jobs, "How many jobs, each of which computes a shard")
      ->type_name(kNumberValue)
      ->check(whole_number(1, kMostJobs))
      ->required();
  command->add_option("-o,--output", arguments->output, "The result file; map.nc unless given")
      ->type_name(kFileValue);
  command->add_option("--cores", arguments->cores, "Cores of a job; 4 unless given")
      ->type_name(kNumberValue)
      ->check(whole_number(1, 1024));
  command->add_option("--time", arguments->time, "Longest time of a job; 01:00:00 unless given")
      ->type_name("HH:MM:SS")
      ->check([](const std::string& text) {
        const bool is_time =
            !text.empty() && text.find_first_not_of("0123456789:-") == std::string::npos;
        return is_time ? "" : fmt::format("'{}' is no time; 12:30:00 is one", text);
      });
  add_device_option(command, &arguments->devices, true);
  add_set_option(command, &arguments->overrides);
  command->footer(
      "Example:\n"
      "  gearsweep slurm mine.toml --jobs 64 -o map.nc > map.sh\n"
      "  sbatch map.sh\n"
      "  gearsweep status map.nc\n"
      "  gearsweep merge map.nc.shard-*.journal -o map.nc\n\n"
      "Jobs that end early or are preempted go on where they were. The program must be on the\n"
      "PATH of the nodes, and the folder on a disk that they share.");
  command->callback([arguments] { print_script(*arguments); });
}

}  // namespace gearsweep
