#include "cli/standard_streams.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <system_error>

namespace gearsweep {
namespace {

[[noreturn]] void fail_to_answer() {
  throw std::system_error(errno, std::generic_category(), "cannot write to standard output");
}

}  // namespace

bool open_standard_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (fcntl(stream, F_GETFD) >= 0) continue;
    // It gets the smallest number that is free, this one. An answer to nobody must fail.
    const int mode = stream == STDOUT_FILENO ? O_RDONLY : O_RDWR;
    if (open("/dev/null", mode) != stream) return false;
  }
  return true;
}

std::string printable(std::string text) {
  const auto byte = [&](std::size_t i) {
    return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U;
  };
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool is_control =
        (byte(i) < 0x20U && text[i] != '\n' && text[i] != '\t') || byte(i) == 0x7fU;
    // U+0080 to U+009F, in UTF-8: some terminals obey these, too.
    const bool begins_control = byte(i) == 0xc2U && byte(i + 1) >= 0x80U && byte(i + 1) < 0xa0U;
    if (begins_control) text.erase(i, 1);
    if (is_control || begins_control) text[i] = '?';
  }
  return text;
}

void answer_text(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) < text.size()) fail_to_answer();
}

void flush_answers() {
  if (std::fflush(stdout) != 0) fail_to_answer();
  // Some network file systems find out when a file is closed.
  const int copy = dup(STDOUT_FILENO);
  if (copy >= 0 && close(copy) != 0) fail_to_answer();
}

std::optional<int> terminal_columns(StandardStream stream) {
  const int number = stream == StandardStream::output ? STDOUT_FILENO : STDERR_FILENO;
  if (isatty(number) == 0) return std::nullopt;
  winsize size{};
  const bool is_known = ioctl(number, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return is_known ? size.ws_col : 80;
}

bool is_heard() {
  pollfd standard_error = {STDERR_FILENO, POLLOUT, 0};
  return poll(&standard_error, 1, 0) == 1;
}

void tell_text(std::string_view text) {
  while (!text.empty()) {
    const ssize_t count = write(STDERR_FILENO, text.data(), text.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return;
    text.remove_prefix(static_cast<std::size_t>(count));
  }
}

}  // namespace gearsweep
