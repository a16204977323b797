// The journal: the durable record of the finished tiles of a running study, one SQLite file beside
// the result. A run that was killed goes on from it.
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/engine.hpp"

namespace gearsweep {

class Database;
class FileLock;

// What decides the numbers of a sweep: names and values (the study's text, a version).
using Identity = std::vector<std::pair<std::string, std::string>>;

// What a journal says of its run.
struct JournalStatus {
  bool is_held = false;                      // by a run that goes on
  std::size_t tiles = 0;                     // finished
  std::size_t points = 0;                    // in them; each trajectory of an ensemble counts
  double seconds = 0.0;                      // that they took
  std::vector<std::string> devices;          // that computed them
  std::map<std::string, std::string> notes;  // the identity and what keep() was given
};

// What of an identity differs from that of a journal, a line for each thing; empty when nothing
// does.
std::string describe_differences(const std::map<std::string, std::string>& notes,
                                 const Identity& identity);

// Holds the journal of a run that does not know yet what its sweep is, as its step is still to be
// found: Journal::status() tells that it goes on, and no other run takes the file.
class JournalHold {
 public:
  // Creates an empty file where there is none; of an empty path it holds nothing. Throws as
  // Journal's constructor does.
  explicit JournalHold(const std::string& path);
  // Deletes a file that is still empty, unless a Journal has taken it over.
  ~JournalHold();
  JournalHold(const JournalHold&) = delete;
  JournalHold& operator=(const JournalHold&) = delete;

 private:
  friend class Journal;
  std::string path_;
  std::unique_ptr<FileLock> lock_;
};

// May be used by several threads. Beside what is said below, its functions throw InputError when
// the file turns out to be damaged (the message says to delete it) and RunError when it cannot be
// read or written.
class Journal {
 public:
  // Opens the journal at `path`, or creates it, for the sweep with this identity, and holds it
  // until it is destroyed or its process ends in whatever way. Throws InputError when the file
  // records another sweep (the message tells what differs), is no journal, or is held by another
  // run. When it throws, it leaves no file that was not there before.
  Journal(const std::string& path, const Identity& identity);
  // The same of a file that is held.
  Journal(JournalHold* held, const Identity& identity);
  ~Journal();

  // Keeps these names and values, in the place of those that it had.
  void keep(const std::map<std::string, std::string>& notes);
  // What it keeps under this name; empty: nothing.
  std::string note(const std::string& name) const;
  std::size_t finished_tiles() const;
  // The stored result of a finished tile, every bit as it was stored; nothing for other tiles.
  std::optional<TileResult> find(std::size_t tile_number) const;
  // Durable when it returns: survives kill -9 and, on a disk that obeys fsync, a power cut.
  // A tile that was stored before is replaced.
  void store(std::size_t tile_number, const TileResult& result);
  // Closes and deletes the journal, once the result file is in place. Nothing may be called after.
  void remove();

  // Deletes the journal at `path`, if there is one. Throws InputError when a run holds it.
  static void discard(const std::string& path);
  // The status of the journal at `path`, whether a run holds it or not. Throws InputError when
  // there is none.
  static JournalStatus status(const std::string& path);

 private:
  mutable std::mutex mutex_;
  std::string path_;
  std::unique_ptr<FileLock> lock_;  // let go of last
  std::unique_ptr<Database> database_;
};

}  // namespace gearsweep
