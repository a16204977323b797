#include "result/output_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <random>
#include <system_error>

#include "model/error.hpp"

namespace gearsweep {
namespace {

namespace fs = std::filesystem;

fs::path folder_of(const std::string& path) {
  const fs::path folder = fs::path(path).parent_path();
  return folder.empty() ? fs::path(".") : folder;
}

void refuse_bad_target(const std::string& path, const std::string& target) {
  const auto refuse = [&](const std::string& reason) {
    throw InputError(fmt::format("cannot write '{}': {}", path, reason));
  };
  std::error_code error, ignored;
  const fs::file_type there = fs::status(target, error).type();
  const fs::path folder = folder_of(target);
  if (fs::path(target).filename().empty() || there == fs::file_type::directory) {
    refuse("it is a folder; give the name of a file");
  }
  if (!fs::exists(folder, ignored)) {
    refuse(fmt::format("there is no folder '{}'", folder.string()));
  }
  if (!fs::is_directory(folder, ignored)) {
    refuse(fmt::format("'{}' is not a folder", folder.string()));
  }
  if (there == fs::file_type::not_found) return;
  if (error) refuse(error.message());
  // Renaming over a device or a write-protected file would work, but nobody means that.
  if (there != fs::file_type::regular) refuse("it is there and not a plain file");
  if (access(target.c_str(), W_OK) != 0) refuse(std::strerror(errno));
}

// Where a symbolic link at `path` leads, or `path` itself.
std::string target_of(const std::string& path) {
  std::error_code ignored;
  if (!fs::is_symlink(path, ignored)) return path;
  const std::string target = fs::weakly_canonical(path, ignored).string();
  return target.empty() ? path : target;
}

constexpr const char* kEnding = ".part";

// A name that nobody has taken yet, most likely.
std::string name_in_the_making(const std::string& target) {
  std::random_device random;
  return fmt::format("{}.{:08x}{}", target, random(), kEnding);
}

// Flushes what was written under this name, a file or a folder, to the disk.
bool flush_to_disk(const std::string& path) {
  const int descriptor = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return false;
  const bool flushed = fsync(descriptor) == 0;
  close(descriptor);
  return flushed;
}

}  // namespace

void ensure_writable(const std::string& path) { const OutputFile probe(path); }

void discard_abandoned(const std::string& path) {
  const std::string target = target_of(path);
  const std::string begin = fs::path(target).filename().string() + ".";
  const std::size_t length = fs::path(name_in_the_making(target)).filename().string().size();
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_of(target), ignored)) {
    const std::string name = entry.path().filename().string();
    if (name.size() == length && name.starts_with(begin) && name.ends_with(kEnding)) {
      fs::remove(entry.path(), ignored);
    }
  }
}

OutputFile::OutputFile(const std::string& path) : path_(path), target_(target_of(path)) {
  refuse_bad_target(path_, target_);
  int descriptor = -1;
  do {
    temporary_ = name_in_the_making(target_);
    descriptor = open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  } while (descriptor < 0 && errno == EEXIST);
  if (descriptor < 0) {
    throw InputError(fmt::format("cannot write '{}': {}", path_, std::strerror(errno)));
  }
  close(descriptor);
}

OutputFile::~OutputFile() {
  if (!temporary_.empty()) unlink(temporary_.c_str());
}

void OutputFile::commit() {
  if (!flush_to_disk(temporary_) || std::rename(temporary_.c_str(), target_.c_str()) != 0) {
    throw RunError(fmt::format("cannot write '{}': {}", path_, std::strerror(errno)));
  }
  temporary_.clear();
  // Some file systems cannot flush a folder; the file itself is safe then.
  flush_to_disk(folder_of(target_).string());
}

void write_file(const std::string& path, std::string_view content) {
  OutputFile file(path);
  std::ofstream out(file.temporary_path(), std::ios::binary);
  out.write(content.data(), static_cast<std::streamsize>(content.size()));
  out.close();
  if (!out) throw RunError(fmt::format("cannot write '{}': {}", path, std::strerror(errno)));
  file.commit();
}

// "TMPDIR=/nowhere": what names the folder for temporary files, as the C++ library asks for it.
std::string given_temporary_folder() {
  for (const char* name : {"TMPDIR", "TMP", "TEMP", "TEMPDIR"}) {
    const char* folder = std::getenv(name);
    if (folder != nullptr) return fmt::format("{}={}", name, folder);
  }
  return "/tmp";
}

TemporaryFolder::TemporaryFolder() {
  std::error_code error;
  const fs::path parent = fs::temp_directory_path(error);
  if (error) {
    throw InputError(fmt::format(
        "there is no folder for temporary files at {} ({}); give another one: TMPDIR=FOLDER",
        given_temporary_folder(), error.message()));
  }
  std::string name = (parent / "gearsweep-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) {
    throw RunError(fmt::format(
        "cannot make a folder for temporary files in '{}': {}; TMPDIR=FOLDER names another one",
        parent.string(), std::strerror(errno)));
  }
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

}  // namespace gearsweep
