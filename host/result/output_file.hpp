// Files that appear whole or not at all: they are written under another name and then renamed.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace gearsweep {

// Throws InputError when no file can be written at `path`: its folder is missing or closed, or
// something that is not a plain file is in the way. Leaves nothing behind.
void ensure_writable(const std::string& path);

// Deletes what killed processes left of files in the making at `path`. Only for whoever knows that
// nobody else writes there now.
void discard_abandoned(const std::string& path);

// The file at `path` in the making. Until commit(), all is written to temporary_path(), an empty
// file in the same folder; without commit() that is removed and `path` stays as it was.
class OutputFile {
 public:
  // Throws what ensure_writable throws.
  explicit OutputFile(const std::string& path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  const std::string& temporary_path() const { return temporary_; }
  // Flushes to the disk and renames. Throws RunError.
  void commit();

 private:
  std::string path_;    // as given, for messages
  std::string target_;  // where a symbolic link at path_ leads
  std::string temporary_;
};

// Writes a whole file. Throws InputError as ensure_writable does, RunError when the disk fails.
void write_file(const std::string& path, std::string_view content);

// A new empty folder for temporary files, removed with all that is in it.
class TemporaryFolder {
 public:
  // Throws InputError where TMPDIR names no folder, RunError where none can be made in it.
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace gearsweep
