// A thin owner of an SQLite connection and of its statements, with errors as exceptions.
#pragma once

#include <sqlite3.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

namespace gearsweep {

// Every error is told by what can be done about it: InputError when the file is not a journal (or a
// damaged one), RunError for all else.
class Database {
 public:
  enum class Opening { create, existing };
  // Opens the file, or creates an empty one where it may.
  explicit Database(const std::string& path, Opening opening = Opening::create);

  // Runs statements that give no rows.
  void execute(const std::string& sql);

  [[noreturn]] void fail(int code) const;
  // The file is not what this program wrote; `reason` says how that shows.
  [[noreturn]] void refuse(const std::string& reason) const;

  sqlite3* handle() const { return handle_.get(); }

 private:
  struct Close {
    void operator()(sqlite3* handle) const { sqlite3_close(handle); }
  };
  std::string path_;
  std::unique_ptr<sqlite3, Close> handle_;
};

// One prepared statement. Parameters count from 1, columns from 0, as in SQLite.
class Statement {
 public:
  Statement(const Database& database, const std::string& sql);

  Statement& bind(int parameter, std::int64_t value);
  Statement& bind_real(int parameter, double value);
  Statement& bind(int parameter, const std::string& text);
  // The bytes must live until the statement has run.
  Statement& bind(int parameter, std::span<const std::byte> bytes);

  // True when there is a row to read.
  bool step();
  // Runs to the end, then is ready for other parameters.
  void run();

  std::int64_t integer(int column) const;
  double real(int column) const;
  std::string text(int column) const;
  // Valid until the next step.
  std::span<const std::byte> bytes(int column) const;

 private:
  struct Finalize {
    void operator()(sqlite3_stmt* handle) const { sqlite3_finalize(handle); }
  };
  void check(int code) const;

  const Database& database_;
  std::unique_ptr<sqlite3_stmt, Finalize> handle_;
};

// Rolls back unless it was committed.
class Transaction {
 public:
  explicit Transaction(Database& database);
  ~Transaction();
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;
  void commit();

 private:
  Database& database_;
};

}  // namespace gearsweep
