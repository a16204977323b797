#include "journal/detail/database.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <system_error>

#include "model/error.hpp"
#include "model/plain_path.hpp"

namespace gearsweep {

Database::Database(const std::string& path, Opening opening) : path_(path) {
  sqlite3* opened = nullptr;
  const int flags = SQLITE_OPEN_READWRITE | SQLITE_OPEN_EXRESCODE |
                    (opening == Opening::create ? SQLITE_OPEN_CREATE : 0);
  const int code = sqlite3_open_v2(plain_path(path).c_str(), &opened, flags, nullptr);
  handle_.reset(opened);
  if (code != SQLITE_OK) fail(code);
  // Another process reads it for a moment, if at all.
  constexpr int kPatience = 30'000;  // ms
  sqlite3_busy_timeout(opened, kPatience);
}

void Database::execute(const std::string& sql) {
  const int code = sqlite3_exec(handle(), sql.c_str(), nullptr, nullptr, nullptr);
  if (code != SQLITE_OK) fail(code);
}

void Database::fail(int code) const {
  const int kind = code & 0xff;
  if (kind == SQLITE_NOTADB || kind == SQLITE_CORRUPT) refuse(sqlite3_errmsg(handle()));
  std::error_code ignored;
  if (code == SQLITE_READONLY_DBMOVED || !std::filesystem::exists(path_, ignored)) {
    throw RunError(fmt::format(
        "the journal '{}' is no longer there: it, or its folder, was deleted or moved away during "
        "the run",
        path_));
  }
  throw RunError(fmt::format("cannot read or write the journal '{}': {} (SQLite error {})", path_,
                             handle() == nullptr ? sqlite3_errstr(code) : sqlite3_errmsg(handle()),
                             code));
}

void Database::refuse(const std::string& reason) const {
  throw InputError(
      fmt::format("'{}' is not a journal of gearsweep, or a damaged one ({}); delete it or choose "
                  "another output",
                  path_, reason));
}

Statement::Statement(const Database& database, const std::string& sql) : database_(database) {
  sqlite3_stmt* prepared = nullptr;
  const int code = sqlite3_prepare_v2(database.handle(), sql.c_str(), -1, &prepared, nullptr);
  handle_.reset(prepared);
  // The text of the statement is right: a plain error means that the file has other tables.
  if (code == SQLITE_ERROR) database.refuse(sqlite3_errmsg(database.handle()));
  check(code);
}

Statement& Statement::bind(int parameter, std::int64_t value) {
  check(sqlite3_bind_int64(handle_.get(), parameter, value));
  return *this;
}

Statement& Statement::bind_real(int parameter, double value) {
  check(sqlite3_bind_double(handle_.get(), parameter, value));
  return *this;
}

Statement& Statement::bind(int parameter, const std::string& text) {
  check(sqlite3_bind_text64(handle_.get(), parameter, text.data(), text.size(), SQLITE_TRANSIENT,
                            SQLITE_UTF8));
  return *this;
}

Statement& Statement::bind(int parameter, std::span<const std::byte> bytes) {
  check(sqlite3_bind_blob64(handle_.get(), parameter, bytes.data(), bytes.size(), SQLITE_STATIC));
  return *this;
}

bool Statement::step() {
  const int code = sqlite3_step(handle_.get());
  if (code == SQLITE_ROW) return true;
  if (code != SQLITE_DONE) database_.fail(code);
  return false;
}

void Statement::run() {
  while (step()) {
  }
  check(sqlite3_reset(handle_.get()));
}

std::int64_t Statement::integer(int column) const {
  return sqlite3_column_int64(handle_.get(), column);
}

double Statement::real(int column) const { return sqlite3_column_double(handle_.get(), column); }

std::string Statement::text(int column) const {
  const std::span<const std::byte> data = bytes(column);
  return {reinterpret_cast<const char*>(data.data()), data.size()};
}

std::span<const std::byte> Statement::bytes(int column) const {
  const void* data = sqlite3_column_blob(handle_.get(), column);
  const int size = sqlite3_column_bytes(handle_.get(), column);
  return {static_cast<const std::byte*>(data), static_cast<std::size_t>(size)};
}

void Statement::check(int code) const {
  if (code != SQLITE_OK) database_.fail(code);
}

Transaction::Transaction(Database& database) : database_(database) {
  database_.execute("BEGIN EXCLUSIVE");
}

Transaction::~Transaction() {
  // Nothing is open after a commit, nor when SQLite itself has rolled back on a full disk.
  if (sqlite3_get_autocommit(database_.handle()) == 0) {
    sqlite3_exec(database_.handle(), "ROLLBACK", nullptr, nullptr, nullptr);
  }
}

void Transaction::commit() { database_.execute("COMMIT"); }

}  // namespace gearsweep
