#include "journal/journal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>
#include <span>
#include <sstream>
#include <system_error>
#include <vector>

#include "journal/detail/database.hpp"
#include "journal/detail/file_lock.hpp"
#include "model/checksum.hpp"
#include "model/error.hpp"
#include "model/regular_file.hpp"

namespace gearsweep {
namespace {

// "gsw3": marks a file as ours, in the place that SQLite keeps for that. A change of the tables
// below needs another mark.
constexpr std::int64_t kApplicationId = 0x67737733;

// A blob of SQLite holds at most 10^9 bytes; longer vectors become several pieces. A multiple of 8,
// so that a piece ends between numbers.
constexpr std::size_t kPieceBytes = std::size_t{64} << 20;

constexpr std::size_t kParts = 5;

std::vector<double> numbers_of(const TileCost& cost) {
  return {cost.steps, cost.seconds, cost.stopped, cost.kernel_seconds};
}

// visit(part number, vector) for each vector of a result, and for the numbers of its cost.
template <class Result, class Numbers, class Visit>
void visit_parts(Result& result, Numbers& cost, const Visit& visit) {
  visit(0, result.status);
  visit(1, result.outputs);
  visit(2, result.samples);
  visit(3, result.final_states);
  visit(4, cost);
}

std::int64_t checksum_of(std::size_t tile_number, const TileResult& result) {
  Checksum checksum;
  checksum.add(tile_number);
  const std::vector<double> cost = numbers_of(result.cost);
  visit_parts(result, cost, [&](int, const auto& values) {
    checksum.add(values.size());
    checksum.add(std::as_bytes(std::span(values)));
  });
  checksum.add(std::as_bytes(std::span(result.device)));
  return static_cast<std::int64_t>(checksum.value());
}

std::int64_t read_integer(const Database& database, const std::string& sql) {
  Statement query(database, sql);
  return query.step() ? query.integer(0) : 0;
}

void create_tables(Database& database, const Identity& identity) {
  database.execute(fmt::format("PRAGMA application_id = {}", kApplicationId));
  database.execute(
      "CREATE TABLE sweep(name TEXT PRIMARY KEY, value TEXT NOT NULL);"
      "CREATE TABLE tile(number INTEGER PRIMARY KEY, size_0 INTEGER NOT NULL, size_1 INTEGER NOT "
      "NULL, size_2 INTEGER NOT NULL, size_3 INTEGER NOT NULL, size_4 INTEGER NOT NULL, checksum "
      "INTEGER NOT NULL, seconds REAL NOT NULL, device TEXT NOT NULL);"
      "CREATE TABLE piece(tile INTEGER NOT NULL, part INTEGER NOT NULL, position INTEGER NOT NULL, "
      "data BLOB NOT NULL, PRIMARY KEY(tile, part, position));");
  Statement note(database, "INSERT INTO sweep VALUES(?, ?)");
  for (const auto& [name, value] : identity) note.bind(1, name).bind(2, value).run();
}

std::map<std::string, std::string> read_notes(const Database& database) {
  std::map<std::string, std::string> notes;
  Statement query(database, "SELECT name, value FROM sweep");
  while (query.step()) notes[query.text(0)] = query.text(1);
  return notes;
}

// The first line in which two texts differ.
std::string describe_difference(const std::string& there, const std::string& here) {
  std::istringstream a(there), b(here);
  std::string line_there, line_here;
  for (std::size_t number = 1;; ++number) {
    const bool has_there = static_cast<bool>(std::getline(a, line_there));
    const bool has_here = static_cast<bool>(std::getline(b, line_here));
    if (!has_there) line_there = "nothing";
    if (!has_here) line_here = "nothing";
    if (line_there != line_here || !has_there || !has_here) {
      const std::string place = number > 1 ? fmt::format(", line {}", number) : "";
      return fmt::format("{}: '{}' there, '{}' now", place, line_there, line_here);
    }
  }
}

void check_identity(Database& database, const std::string& path, const Identity& identity) {
  if (read_integer(database, "PRAGMA application_id") != kApplicationId) {
    database.refuse("a database of another program or version");
  }
  const std::map<std::string, std::string> notes = read_notes(database);
  if (notes.empty()) database.refuse("it names no sweep");
  const std::string differences = describe_differences(notes, identity);
  if (differences.empty()) return;
  const std::int64_t tiles = read_integer(database, "SELECT count(*) FROM tile");
  if (tiles > 0) {
    throw InputError(fmt::format(
        "'{}' records {} finished tiles of another sweep; delete it (--restart does) or "
        "choose another output; what differs:{}",
        path, tiles, differences));
  }
  // Nothing would be lost: the journal is as good as new.
  Statement(database, "DELETE FROM sweep").run();
  Statement note(database, "INSERT INTO sweep VALUES(?, ?)");
  for (const auto& [name, value] : identity) note.bind(1, name).bind(2, value).run();
}

// The journal and what SQLite keeps beside it; the journal is the last.
constexpr std::array<const char*, 4> kSuffixes = {"-journal", "-wal", "-shm", ""};

// SQLite would open whatever is there. Whether there is a journal.
bool has_journal(const std::string& path) {
  bool has_file = false;
  for (const char* suffix : kSuffixes) has_file = has_regular_file(path + suffix, "a journal");
  return has_file;
}

// Deletes the journal and what SQLite keeps beside it; returns what went wrong, empty if nothing.
// The journal goes last: if the process dies in between, the next run still has all that it needs.
std::string delete_files(const std::string& path) {
  for (const char* suffix : kSuffixes) {
    std::error_code error;
    std::filesystem::remove(path + suffix, error);
    if (error) return fmt::format("cannot delete '{}{}': {}", path, suffix, error.message());
  }
  return "";
}

}  // namespace

std::string describe_differences(const std::map<std::string, std::string>& notes,
                                 const Identity& identity) {
  std::string differences;
  for (const auto& [name, value] : identity) {
    const auto there = notes.find(name);
    if (there == notes.end()) {
      differences += fmt::format("\n  {}: not told there", name);
    } else if (there->second != value) {
      differences += fmt::format("\n  {}{}", name, describe_difference(there->second, value));
    }
  }
  return differences;
}

JournalHold::JournalHold(const std::string& path) : path_(path) {
  if (path.empty()) return;
  has_journal(path);  // throws where there is something that can be none
  lock_ = std::make_unique<FileLock>(path);
}

JournalHold::~JournalHold() {
  std::error_code error;
  if (lock_ && lock_->is_of(path_) && std::filesystem::file_size(path_, error) == 0) {
    delete_files(path_);  // while it is held, so that another run cannot take it up in between
  }
}

// The rollback journal (SQLite's default) writes each byte of an appended tile once, a write-ahead
// log would write it twice and needs shared memory, which network file systems do not have. Either
// keeps a commit through kill -9, since the system has the bytes then; synchronous FULL brings them
// to the disk before the commit returns, which a power cut needs.
Journal::Journal(JournalHold* held, const Identity& identity)
    : path_(held->path_), lock_(std::move(held->lock_)) {
  try {
    database_ = std::make_unique<Database>(path_);
    database_->execute("PRAGMA synchronous = FULL");
    Transaction transaction(*database_);
    if (read_integer(*database_, "SELECT count(*) FROM sqlite_schema") > 0) {
      check_identity(*database_, path_, identity);
    } else {
      create_tables(*database_, identity);
    }
    transaction.commit();
  } catch (...) {
    if (lock_->has_created()) delete_files(path_);
    throw;
  }
}

Journal::Journal(const std::string& path, const Identity& identity)
    : Journal(std::make_unique<JournalHold>(path).get(), identity) {}

Journal::~Journal() = default;

void Journal::keep(const std::map<std::string, std::string>& notes) {
  const std::lock_guard lock(mutex_);
  Transaction transaction(*database_);
  Statement insert(*database_, "INSERT OR REPLACE INTO sweep VALUES(?, ?)");
  for (const auto& [name, value] : notes) insert.bind(1, name).bind(2, value).run();
  transaction.commit();
}

std::string Journal::note(const std::string& name) const {
  const std::lock_guard lock(mutex_);
  Statement query(*database_, "SELECT value FROM sweep WHERE name = ?");
  query.bind(1, name);
  return query.step() ? query.text(0) : "";
}

std::size_t Journal::finished_tiles() const {
  const std::lock_guard lock(mutex_);
  return static_cast<std::size_t>(read_integer(*database_, "SELECT count(*) FROM tile"));
}

std::optional<TileResult> Journal::find(std::size_t tile_number) const {
  const std::lock_guard lock(mutex_);
  const auto number = static_cast<std::int64_t>(tile_number);
  Statement row(
      *database_,
      "SELECT size_0, size_1, size_2, size_3, size_4, checksum, device FROM tile WHERE number = ?");
  row.bind(1, number);
  if (!row.step()) return std::nullopt;

  TileResult result;
  std::vector<double> cost;
  result.device = row.text(kParts + 1);
  visit_parts(result, cost, [&](int part, auto& values) {
    Statement pieces(*database_,
                     "SELECT data FROM piece WHERE tile = ? AND part = ? ORDER BY position");
    pieces.bind(1, number).bind(2, part);
    while (pieces.step()) {
      const std::span<const std::byte> bytes = pieces.bytes(0);
      const std::size_t before = values.size();
      values.resize(before + bytes.size() / sizeof(values[0]));
      std::memcpy(values.data() + before, bytes.data(),
                  (values.size() - before) * sizeof(values[0]));
    }
    if (values.size() != static_cast<std::uint64_t>(row.integer(part))) {
      database_->refuse(fmt::format("tile {} is incomplete", tile_number));
    }
  });
  if (cost.size() != numbers_of({}).size()) {
    database_->refuse(fmt::format("tile {} does not say what it took", tile_number));
  }
  result.cost = {cost[0], cost[1], cost[2], cost[3]};
  if (checksum_of(tile_number, result) != row.integer(kParts)) {
    database_->refuse(fmt::format("tile {} was changed after it was stored", tile_number));
  }
  return result;
}

void Journal::store(std::size_t tile_number, const TileResult& result) {
  const std::lock_guard lock(mutex_);
  const auto number = static_cast<std::int64_t>(tile_number);
  Transaction transaction(*database_);
  Statement(*database_, "DELETE FROM piece WHERE tile = ?").bind(1, number).run();
  Statement row(*database_, "INSERT OR REPLACE INTO tile VALUES(?, ?, ?, ?, ?, ?, ?, ?, ?)");
  Statement piece(*database_, "INSERT INTO piece VALUES(?, ?, ?, ?)");
  row.bind(1, number).bind(kParts + 2, checksum_of(tile_number, result));
  row.bind_real(kParts + 3, result.cost.seconds);
  row.bind(kParts + 4, result.device);
  const std::vector<double> cost = numbers_of(result.cost);
  visit_parts(result, cost, [&](int part, const auto& values) {
    row.bind(part + 2, static_cast<std::int64_t>(values.size()));
    const std::span<const std::byte> bytes = std::as_bytes(std::span(values));
    for (std::size_t start = 0; start < bytes.size(); start += kPieceBytes) {
      const std::size_t length = std::min(kPieceBytes, bytes.size() - start);
      piece.bind(1, number).bind(2, part).bind(3, static_cast<std::int64_t>(start));
      piece.bind(4, bytes.subspan(start, length)).run();
    }
  });
  row.run();
  transaction.commit();
}

void Journal::remove() {
  const std::lock_guard lock(mutex_);
  // Deleted while the lock is held, so that another run cannot take the file up in between.
  const std::string failure = lock_->is_of(path_) ? delete_files(path_) : "";
  database_.reset();
  lock_.reset();
  if (!failure.empty()) throw RunError(failure);
}

void Journal::discard(const std::string& path) {
  if (!has_journal(path)) return;
  const FileLock lock(path);
  const std::string failure = delete_files(path);
  if (!failure.empty()) throw RunError(failure);
}

JournalStatus Journal::status(const std::string& path) {
  if (!has_journal(path)) throw InputError(fmt::format("'{}': there is no such journal", path));
  JournalStatus status;
  status.is_held = FileLock::is_held(path);
  const Database database(path, Database::Opening::existing);
  // A run has just begun, or was killed as it did.
  if (read_integer(database, "SELECT count(*) FROM sqlite_schema") == 0) return status;
  if (read_integer(database, "PRAGMA application_id") != kApplicationId) {
    database.refuse("a database of another program or version");
  }
  status.notes = read_notes(database);
  Statement sums(database, "SELECT count(*), sum(size_0), sum(seconds) FROM tile");
  if (sums.step()) {
    status.tiles = static_cast<std::size_t>(sums.integer(0));
    status.points = static_cast<std::size_t>(sums.integer(1));
    status.seconds = sums.real(2);
  }
  Statement devices(database, "SELECT DISTINCT device FROM tile ORDER BY device");
  while (devices.step()) status.devices.push_back(devices.text(0));
  return status;
}

}  // namespace gearsweep
