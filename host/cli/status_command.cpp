// gearsweep status: how far a running or interrupted study is.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <vector>

#include "cli/commands.hpp"
#include "cli/detail/arguments.hpp"
#include "cli/detail/progress_bar.hpp"
#include "cli/detail/shard_status.hpp"
#include "cli/standard_streams.hpp"
#include "journal/journal.hpp"
#include "journal/notes.hpp"
#include "model/error.hpp"
#include "model/regular_file.hpp"
#include "result/broken_file.hpp"
#include "result/json_text.hpp"
#include "result/result_file.hpp"

namespace gearsweep {
namespace {

std::string note(const JournalStatus& status, const std::string& name) {
  const auto found = status.notes.find(name);
  return found == status.notes.end() ? "" : found->second;
}

std::size_t planned_points(const JournalStatus& status) {
  const std::string text = note(status, notes::kPoints);
  return text.empty() ? 0 : read_count(text);
}

// What a run notes when its tiles are planned.
bool is_planned(const JournalStatus& status) { return !note(status, notes::kPoints).empty(); }

// 0 to 1; 0 when nothing is planned yet.
double share_of(const JournalStatus& status) {
  const std::size_t planned = planned_points(status);
  if (planned == 0) return is_planned(status) ? 1.0 : 0.0;
  return static_cast<double>(status.points) / static_cast<double>(planned);
}

// A shard that is done has nothing but its journal, as does a result that was not written.
std::string state_of(const JournalStatus& status) {
  if (status.is_held) return "running";
  return share_of(status) == 1.0 ? "computed" : "interrupted";
}

// A search for curves, whose parts are not known before it has found them.
bool is_search(const JournalStatus& status) { return !note(status, notes::kSearch).empty(); }

std::string describe_search(const std::string& output, const JournalStatus& status) {
  std::string text = fmt::format("{}: a search for curves, {}; {} of its parts are finished\n",
                                 output, status.is_held ? "running" : "interrupted", status.tiles);
  if (!status.is_held) text += fmt::format("to continue: {}\n", note(status, notes::kCommand));
  return text;
}

std::string describe(const std::string& output, const JournalStatus& status) {
  if (is_search(status)) return describe_search(output, status);
  if (!is_planned(status)) {
    return status.is_held
               ? fmt::format(
                     "{}: running, nothing is done yet: the step is being found, or kernels "
                     "are being built\n",
                     output)
               : fmt::format("{}: interrupted before anything was done; run it again\n", output);
  }
  const double share = share_of(status);
  std::string text =
      fmt::format("{}: {}, {:.1f} % done: {} of {} points in {} tiles", output, state_of(status),
                  100.0 * share, status.points, planned_points(status), status.tiles);
  if (share > 0.0 && share < 1.0) {
    text += fmt::format("; computed for {}, about {} left", format_duration(status.seconds),
                        format_duration(status.seconds / share * (1.0 - share)));
  }
  text += '\n';
  if (status.tiles > 0) text += fmt::format("on {}\n", fmt::join(status.devices, "; "));
  if (!status.is_held && share < 1.0)
    text += fmt::format("to continue: {}\n", note(status, notes::kCommand));
  return text;
}

nlohmann::json as_json(const std::string& output, const JournalStatus& status) {
  if (is_search(status)) {
    return {{"output", output},
            {"state", status.is_held ? "running" : "interrupted"},
            {"share", nullptr},
            {"parts_done", status.tiles},
            {"command", note(status, notes::kCommand)}};
  }
  const double share = share_of(status);
  return {{"output", output},
          {"state", state_of(status)},
          {"share", share},
          {"points_done", status.points},
          {"points", planned_points(status)},
          {"tiles_done", status.tiles},
          {"seconds", status.seconds},
          {"devices", status.devices},
          {"command", note(status, notes::kCommand)}};
}

// Shards that have not begun have no journal: how many points they have is not known.
std::string describe(const std::string& output, const std::vector<ShardState>& shards) {
  std::map<std::size_t, std::map<std::string, std::vector<std::size_t>>> by_count;  // and state
  std::string unfinished;
  for (const ShardState& one : shards) {
    by_count[one.shard.count][state_of(one.status)].push_back(one.shard.number);
    if (share_of(one.status) < 1.0) unfinished += describe(one.journal, one.status);
  }
  std::string text;
  for (const auto& [count, by_state] : by_count) {
    text += fmt::format("{}, in {} shards", output, count);
    for (const auto& [state, numbers] : by_state) {
      text += fmt::format("; {}: {}", state, fmt::join(numbers, ", "));
    }
    text += '\n';
    const auto computed = by_state.find("computed");
    if (computed != by_state.end() && computed->second.size() == count) {
      text +=
          fmt::format("to put them together: gearsweep merge {0}.shard-*-of-{1}.journal -o {0}\n",
                      shell_quoted(output), count);
    }
  }
  return text + unfinished;
}

nlohmann::json as_json(const std::string& output, const std::vector<ShardState>& shards) {
  nlohmann::json all = {
      {"output", output}, {"state", "shards"}, {"shards", nlohmann::json::array()}};
  for (const ShardState& one : shards) {
    nlohmann::json shard = as_json(one.journal, one.status);
    shard["shard"] = fmt::format("{}/{}", one.shard.number, one.shard.count);
    all["shards"].push_back(std::move(shard));
  }
  return all;
}

void show(const std::string& output, bool with_json) {
  const std::string journal = output.ends_with(".journal") ? output : output + ".journal";
  if (has_regular_file(journal, "a journal")) {
    const JournalStatus status = Journal::status(journal);
    answer("{}", with_json ? json_text(as_json(output, status)) : describe(output, status));
  } else if (has_regular_file(output, "a result")) {
    ensure_not_broken(output);
    const ResultFile whole(output);  // throws when it is none
    answer("{}", with_json ? json_text({{"output", output}, {"state", "finished"}})
                           : fmt::format("{}: finished\n", output));
  } else if (const std::vector<ShardState> shards = shards_of(output); !shards.empty()) {
    answer("{}", with_json ? json_text(as_json(output, shards)) : describe(output, shards));
  } else {
    throw InputError(fmt::format(
        "{0}: there is neither this result nor {0}.journal of a run that is to write it", output));
  }
}

}  // namespace

void add_status_command(CLI::App* app) {
  CLI::App* command = app->add_subcommand("status", "How far a running or interrupted study is");
  const auto output = std::make_shared<std::string>();
  const auto with_json = std::make_shared<bool>(false);
  command
      ->add_option("output", *output,
                   "The result file that the run is to write, OUT.nc, or a journal")
      ->type_name(kResultValue)
      ->required();
  command->add_flag("--json", *with_json, "For scripts");
  command->footer("Example: gearsweep status map.nc");
  command->callback([output, with_json] { show(*output, *with_json); });
}

}  // namespace gearsweep
