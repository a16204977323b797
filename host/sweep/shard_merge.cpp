#include "sweep/shard_merge.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <map>
#include <memory>
#include <set>
#include <sstream>

#include "model/error.hpp"
#include "sweep/assembly.hpp"
#include "sweep/run_context.hpp"
#include "tile/subset.hpp"

namespace gearsweep {
namespace {

// From the note that a run keeps.
PilotFindings unpack_pilot(const std::string& text) {
  PilotFindings pilot;
  std::istringstream in(text);
  in >> pilot.step.max_step >> pilot.step.orbit_steps >> pilot.error >> pilot.kept >>
      pilot.sensitive >> pilot.max_sensitive >> pilot.points;
  std::string quantity;
  for (double error = 0.0; in >> quantity >> error;) pilot.errors[quantity] = error;
  return pilot;
}

// Journals of shards, by number, of which the first is the measure for the others.
class ShardJournals {
 public:
  explicit ShardJournals(const std::vector<std::string>& paths)
      : first_(Journal::status(paths.front())), study_(study_of(paths.front())) {
    const std::size_t count = shard_of(paths.front(), first_).count;
    for (const std::string& path : paths) add(path, count);
    std::vector<std::size_t> missing;
    for (std::size_t number = 1; number <= count; ++number) {
      if (journals_.count(number) == 0) missing.push_back(number);
    }
    if (missing.empty()) return;
    throw InputError(
        fmt::format("of the {} shards there is no journal of number {}; run them with "
                    "--shard and name all journals",
                    count, fmt::join(missing, ", ")));
  }

  const Study& study() const { return study_; }
  Plan plan() const { return {study_, read_count(note(first_, notes::kTilePoints), 1)}; }
  std::string note(const std::string& name) const { return note(first_, name); }

  TileResult tile(std::size_t number) const {
    const std::size_t shard = number % journals_.size() + 1;
    const Entry& entry = journals_.at(shard);
    std::optional<TileResult> result = entry.journal->find(number);
    if (!result) {
      throw InputError(fmt::format(
          "'{}': this shard is not finished ('gearsweep status {}' tells how far it is); it "
          "continues with: {}",
          entry.path, entry.path, entry.command));
    }
    return *std::move(result);
  }

 private:
  struct Entry {
    std::string path, command;
    std::unique_ptr<Journal> journal;
  };

  static std::string note(const JournalStatus& status, const std::string& name) {
    const auto found = status.notes.find(name);
    return found == status.notes.end() ? "" : found->second;
  }

  Study study_of(const std::string& path) const {
    if (note(first_, notes::kTilePoints).empty()) {
      throw InputError(fmt::format("'{}': nothing of this shard is finished", path));
    }
    Study study = read_study(note(first_, notes::kStudy), path, {}, {}, {}, NamedFiles::refused);
    FoundStep{read_step(note(first_, notes::kStep)),
              read_count(note(first_, notes::kOrbitSteps), 1)}
        .give_to(&study);
    return study;
  }

  static Shard shard_of(const std::string& path, const JournalStatus& status) {
    const std::string text = note(status, notes::kShard);
    if (text.empty()) {
      throw InputError(
          fmt::format("'{}' is the journal of a whole run, not of a shard; 'gearsweep run' "
                      "continues it",
                      path));
    }
    return parse_shard(text);
  }

  void add(const std::string& path, std::size_t count) {
    const JournalStatus status = Journal::status(path);
    const Shard shard = shard_of(path, status);
    if (shard.count != count) {
      throw InputError(fmt::format("'{}' is one of {} shards, the first journal one of {}", path,
                                   shard.count, count));
    }
    const Identity identity = identity_of(study_, shard);
    const std::string differences = describe_differences(status.notes, identity);
    if (!differences.empty()) {
      throw InputError(
          fmt::format("'{}' is a shard of another sweep than the first journal; what "
                      "differs:{}",
                      path, differences));
    }
    const std::string cut = note(status, notes::kTilePoints);
    if (cut != note(first_, notes::kTilePoints)) {
      throw InputError(fmt::format(
          "'{}' was cut into tiles of {} points, the first journal into tiles of {}; give "
          "integrate.tile in the study when shards run on machines of different kinds",
          path, cut, note(first_, notes::kTilePoints)));
    }
    if (journals_.count(shard.number) > 0) {
      throw InputError(fmt::format("'{}' and '{}' are both shard {} of {}",
                                   journals_.at(shard.number).path, path, shard.number, count));
    }
    journals_[shard.number] = {path, note(status, notes::kCommand),
                               std::make_unique<Journal>(path, identity)};
  }

  const JournalStatus first_;
  const Study study_;
  std::map<std::size_t, Entry> journals_;
};

}  // namespace

SweepResult merge_shards(const std::vector<std::string>& journals) {
  const ShardJournals shards(journals);
  const Plan plan = shards.plan();
  Assembly assembly(shards.study(), plan.study().model->states.size());
  const std::vector<const Tile*> tiles = tiles_of(plan);
  for (std::size_t number = 0; number < tiles.size(); ++number) {
    const TileResult result = shards.tile(number);
    require_fit(plan.study(), *tiles[number], result);
    assembly.add(plan, *tiles[number], result);
  }
  SweepResult result = assembly.take();
  result.engine.driver = shards.note(notes::kDriver);
  result.engine.macros = shards.note(notes::kBuildOptions);
  result.integrated = plan.study().model->state_names();
  const std::string& pilot = shards.note(notes::kPilot);
  if (!pilot.empty()) result.pilot = unpack_pilot(pilot);
  return result;
}

}  // namespace gearsweep
