// What another process says until it ends.
#pragma once

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <string>

#include "model/error.hpp"

namespace gearsweep {

// Both ends of a pipe; what is open is closed in the end.
class Pipe {
 public:
  // partner: whom the pipe is for. Throws RunError.
  explicit Pipe(const std::string& partner) {
    if (pipe2(ends_.data(), O_CLOEXEC) != 0) {
      throw RunError(fmt::format("cannot make a pipe to {}: {}", partner, std::strerror(errno)));
    }
  }
  ~Pipe() {
    close(ends_[0]);
    close_writer();
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;

  int writer() const { return ends_[1]; }
  void close_writer() {
    if (ends_[1] >= 0) close(ends_[1]);
    ends_[1] = -1;
  }
  // All until the other side closes.
  std::string read_all() const {
    std::string all;
    std::array<char, 4096> buffer;
    for (;;) {
      const ssize_t count = read(ends_[0], buffer.data(), buffer.size());
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) return all;
      all.append(buffer.data(), static_cast<std::size_t>(count));
    }
  }

 private:
  std::array<int, 2> ends_{-1, -1};
};

}  // namespace gearsweep
