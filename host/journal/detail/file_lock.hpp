// A lock on a file that ends with its process, in whatever way that ends.
#pragma once

#include <string>

namespace gearsweep {

// Holds a byte of the file far beyond those that SQLite locks, by a lock of the open file (not of
// the process), so that neither knows of the other. Works on network file systems that have locks.
class FileLock {
 public:
  // Opens the file, or creates an empty one, and locks it. Throws InputError when another run holds
  // it, RunError when it cannot be opened.
  explicit FileLock(const std::string& path);
  ~FileLock();
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

  bool has_created() const { return has_created_; }
  // Whether a process holds the file; false when there is none.
  static bool is_held(const std::string& path);

  // Whether the file is still the one at the path.
  bool is_of(const std::string& path) const;

 private:
  int file_ = -1;
  bool has_created_ = false;
};

}  // namespace gearsweep
