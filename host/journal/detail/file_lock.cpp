#include "journal/detail/file_lock.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "model/error.hpp"

namespace gearsweep {
namespace {

// SQLite locks bytes from 2^30 on, fewer than 1024.
struct flock byte_of_run() {
  struct flock range = {};
  range.l_type = F_WRLCK;
  range.l_whence = SEEK_SET;
  range.l_start = (off_t{1} << 30) + 4096;
  range.l_len = 1;
  return range;
}

int open_or_create(const std::string& path, bool* has_created) {
  constexpr mode_t kMode = 0644;
  const int created = ::open(path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, kMode);
  *has_created = created >= 0;
  if (created >= 0 || errno != EEXIST) return created;
  return ::open(path.c_str(), O_RDWR | O_CLOEXEC);
}

}  // namespace

FileLock::FileLock(const std::string& path) {
  // A run that has just finished may have deleted the file between our opening and locking it.
  do {
    if (file_ >= 0) ::close(file_);
    file_ = open_or_create(path, &has_created_);
    if (file_ < 0) {
      throw RunError(fmt::format("cannot read or write the journal '{}': {}", path,
                                 std::generic_category().message(errno)));
    }
    struct flock range = byte_of_run();
    if (::fcntl(file_, F_OFD_SETLK, &range) != 0) {
      const int reason = errno;
      ::close(file_);
      if (reason != EAGAIN && reason != EACCES) {
        throw RunError(fmt::format("cannot lock the journal '{}': {}", path,
                                   std::generic_category().message(reason)));
      }
      throw InputError(
          fmt::format("'{}' is in use by another run that writes the same output; wait until it "
                      "ends or choose another output",
                      path));
    }
  } while (!is_of(path));
}

FileLock::~FileLock() { ::close(file_); }

bool FileLock::is_held(const std::string& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return false;
  struct flock range = byte_of_run();
  const bool is_held = ::fcntl(file, F_OFD_GETLK, &range) == 0 && range.l_type != F_UNLCK;
  ::close(file);
  return is_held;
}

bool FileLock::is_of(const std::string& path) const {
  struct stat mine = {}, there = {};
  return ::fstat(file_, &mine) == 0 && ::stat(path.c_str(), &there) == 0 &&
         mine.st_ino == there.st_ino && mine.st_dev == there.st_dev;
}

}  // namespace gearsweep
