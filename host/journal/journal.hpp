// The journal: the durable record of the finished tiles of a running study, one SQLite file beside
// the result. A run that was killed goes on from it.
#pragma once

#include <cstddef>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "engine/engine.hpp"

namespace gearsweep {

class Database;

// May be used by several threads. Beside what is said below, its functions throw InputError when
// the file turns out to be damaged (the message says to delete it) and RunError when it cannot be
// read or written.
class Journal {
 public:
  // Opens the journal at `path`, or creates it, for the sweep with this fingerprint, and holds it
  // until it is destroyed or its process ends in whatever way. Throws InputError when the file
  // records another sweep, is no journal, or is held by another run. When it throws, it leaves no
  // file that was not there before.
  Journal(const std::string& path, const std::string& fingerprint);
  ~Journal();

  std::size_t finished_tiles() const;
  // The stored result of a finished tile, every bit as it was stored; nothing for other tiles.
  std::optional<TileResult> find(std::size_t tile_number) const;
  // Durable when it returns: survives kill -9 and, on a disk that obeys fsync, a power cut.
  // A tile that was stored before is replaced.
  void store(std::size_t tile_number, const TileResult& result);
  // Closes and deletes the journal, once the result file is in place. Nothing may be called after.
  void remove();

 private:
  mutable std::mutex mutex_;
  std::string path_;
  std::unique_ptr<Database> database_;
};

}  // namespace gearsweep
