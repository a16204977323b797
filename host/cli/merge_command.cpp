// gearsweep merge: the result of a study that ran in shards.
#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "cli/commands.hpp"
#include "cli/detail/arguments.hpp"
#include "cli/detail/summary.hpp"
#include "cli/standard_streams.hpp"
#include "model/error.hpp"
#include "model/version.hpp"
#include "result/result_file.hpp"
#include "sweep/shard_merge.hpp"

namespace gearsweep {
namespace {

struct MergeArguments {
  std::vector<std::string> journals;
  std::string output;
  bool quiet = false;
};

int merge(const MergeArguments& arguments) {
  require_result_path(arguments.output);
  for (const std::string& journal : arguments.journals) {
    if (!is_netcdf(journal)) continue;
    throw InputError(fmt::format(
        "'{}' is a result, not a journal; merge takes what 'gearsweep run --shard' left: "
        "OUT.nc.shard-*.journal",
        journal));
  }
  ensure_writable(arguments.output);
  const SweepResult result = merge_shards(arguments.journals);
  const std::string command = fmt::format("gearsweep merge -o '{}' ({} shards)", arguments.output,
                                          arguments.journals.size());
  write_result(result, arguments.output, {command, version(), source_hash()});
  if (!arguments.quiet) tell("{}", describe_run(result, arguments.output));
  return status_of(result);
}

}  // namespace

void add_merge_command(CLI::App* app, int* status) {
  CLI::App* command = app->add_subcommand("merge", "Put the shards of a study together");
  const auto arguments = std::make_shared<MergeArguments>();
  command
      ->add_option("journals", arguments->journals,
                   "What 'gearsweep run --shard' left of each shard, in any order")
      ->type_name(kFileValue)
      ->required();
  command->add_option("-o,--output", arguments->output, "The result file")
      ->type_name(kFileValue)
      ->required();
  command->add_flag("--quiet", arguments->quiet, "No summary");
  command->footer(
      "Example, a job array of four (each job on its own, in any order):\n"
      "  gearsweep run mine.toml -o map.nc --shard 1/4      .. 4/4\n"
      "  gearsweep merge map.nc.shard-*.journal -o map.nc\n\n"
      "The result is that of one run, to the bit. The journals stay; delete them when you have\n"
      "the result.");
  command->callback([arguments, status] { *status = merge(*arguments); });
}

}  // namespace gearsweep
