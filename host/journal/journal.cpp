#include "journal/journal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>
#include <span>
#include <system_error>
#include <vector>

#include "journal/database.hpp"
#include "model/checksum.hpp"
#include "model/error.hpp"

namespace gearsweep {
namespace {

// "gsw2": marks a file as ours, in the place that SQLite keeps for that. A change of the tables
// below needs another mark.
constexpr std::int64_t kApplicationId = 0x67737732;

// A blob of SQLite holds at most 10^9 bytes; longer vectors become several pieces. A multiple of 8,
// so that a piece ends between numbers.
constexpr std::size_t kPieceBytes = std::size_t{64} << 20;

constexpr std::size_t kParts = 5;

// visit(part number, vector) for each vector of a result.
template <class Result, class Visit>
void visit_parts(Result& result, const Visit& visit) {
  visit(0, result.status);
  visit(1, result.outputs);
  visit(2, result.samples);
  visit(3, result.final_states);
  visit(4, result.effort);
}

std::int64_t checksum_of(std::size_t tile_number, const TileResult& result) {
  Checksum checksum;
  checksum.add(tile_number);
  visit_parts(result, [&](int, const auto& values) {
    checksum.add(values.size());
    checksum.add(std::as_bytes(std::span(values)));
  });
  return static_cast<std::int64_t>(checksum.value());
}

std::int64_t read_integer(const Database& database, const std::string& sql) {
  Statement query(database, sql);
  return query.step() ? query.integer(0) : 0;
}

void create_tables(Database& database, const std::string& fingerprint) {
  database.execute(fmt::format("PRAGMA application_id = {}", kApplicationId));
  database.execute(
      "CREATE TABLE sweep(fingerprint TEXT NOT NULL);"
      "CREATE TABLE tile(number INTEGER PRIMARY KEY, size_0 INTEGER NOT NULL, size_1 INTEGER NOT "
      "NULL, size_2 INTEGER NOT NULL, size_3 INTEGER NOT NULL, size_4 INTEGER NOT NULL, checksum "
      "INTEGER NOT NULL);"
      "CREATE TABLE piece(tile INTEGER NOT NULL, part INTEGER NOT NULL, position INTEGER NOT NULL, "
      "data BLOB NOT NULL, PRIMARY KEY(tile, part, position));");
  Statement(database, "INSERT INTO sweep VALUES(?)").bind(1, fingerprint).run();
}

void check_fingerprint(Database& database, const std::string& path,
                       const std::string& fingerprint) {
  if (read_integer(database, "PRAGMA application_id") != kApplicationId) {
    database.refuse("a database of another program or version");
  }
  Statement query(database, "SELECT fingerprint FROM sweep");
  if (!query.step()) database.refuse("it names no sweep");
  if (query.text(0) == fingerprint) return;
  const std::int64_t tiles = read_integer(database, "SELECT count(*) FROM tile");
  if (tiles > 0) {
    throw InputError(fmt::format(
        "'{}' records {} finished tiles of another sweep; delete it (--restart does) or "
        "choose another output",
        path, tiles));
  }
  // Nothing would be lost: the journal is as good as new.
  Statement(database, "UPDATE sweep SET fingerprint = ?").bind(1, fingerprint).run();
}

// Deletes the journal and what SQLite keeps beside it; returns what went wrong, empty if nothing.
// The journal goes last: if the process dies in between, the next run still has all that it needs.
std::string delete_files(const std::string& path) {
  for (const char* suffix : {"-journal", "-wal", "-shm", ""}) {
    std::error_code error;
    std::filesystem::remove(path + suffix, error);
    if (error) return fmt::format("cannot delete '{}{}': {}", path, suffix, error.message());
  }
  return "";
}

}  // namespace

// Settings. locking_mode EXCLUSIVE keeps the lock of the first transaction until the file is
// closed; the system drops it with the process. The rollback journal (SQLite's default) writes each
// byte of an appended tile once, a write-ahead log would write it twice. Either keeps a commit
// through kill -9, since the system has the bytes then; synchronous FULL brings them to the disk
// before the commit returns, which a power cut needs.
Journal::Journal(const std::string& path, const std::string& fingerprint)
    : path_(path), database_(std::make_unique<Database>(path)) {
  database_->execute("PRAGMA locking_mode = EXCLUSIVE");
  database_->execute("PRAGMA synchronous = FULL");
  Transaction transaction(*database_);
  if (read_integer(*database_, "SELECT count(*) FROM sqlite_schema") > 0) {
    check_fingerprint(*database_, path, fingerprint);
    transaction.commit();
    return;
  }
  try {
    create_tables(*database_, fingerprint);
    transaction.commit();
  } catch (...) {
    delete_files(path);
    throw;
  }
}

Journal::~Journal() = default;

std::size_t Journal::finished_tiles() const {
  const std::lock_guard lock(mutex_);
  return static_cast<std::size_t>(read_integer(*database_, "SELECT count(*) FROM tile"));
}

std::optional<TileResult> Journal::find(std::size_t tile_number) const {
  const std::lock_guard lock(mutex_);
  const auto number = static_cast<std::int64_t>(tile_number);
  Statement row(
      *database_,
      "SELECT size_0, size_1, size_2, size_3, size_4, checksum FROM tile WHERE number = ?");
  row.bind(1, number);
  if (!row.step()) return std::nullopt;

  TileResult result;
  visit_parts(result, [&](int part, auto& values) {
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
  Statement row(*database_, "INSERT OR REPLACE INTO tile VALUES(?, ?, ?, ?, ?, ?, ?)");
  Statement piece(*database_, "INSERT INTO piece VALUES(?, ?, ?, ?)");
  row.bind(1, number).bind(kParts + 2, checksum_of(tile_number, result));
  visit_parts(result, [&](int part, const auto& values) {
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
  const std::string failure = delete_files(path_);
  database_.reset();
  if (!failure.empty()) throw RunError(failure);
}

}  // namespace gearsweep
