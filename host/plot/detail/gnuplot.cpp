#include "plot/detail/gnuplot.hpp"

#include <fmt/format.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string_view>
#include <vector>

#include "model/error.hpp"
#include "model/plain_path.hpp"
#include "result/pipe.hpp"

extern char** environ;

namespace gearsweep {
namespace {

// Signals do to the new process what they do by themselves, whatever this one does about them.
class SpawnAttributes {
 public:
  SpawnAttributes() {
    posix_spawnattr_init(&attributes_);
    sigset_t none, ignored;
    sigemptyset(&none);
    sigemptyset(&ignored);
    for (const int signal_number : {SIGPIPE, SIGXFSZ}) sigaddset(&ignored, signal_number);
    posix_spawnattr_setsigmask(&attributes_, &none);
    posix_spawnattr_setsigdefault(&attributes_, &ignored);
    posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
  }
  ~SpawnAttributes() { posix_spawnattr_destroy(&attributes_); }
  SpawnAttributes(const SpawnAttributes&) = delete;
  SpawnAttributes& operator=(const SpawnAttributes&) = delete;

  const posix_spawnattr_t* get() const { return &attributes_; }

 private:
  posix_spawnattr_t attributes_;
};

// This process's environment, but for the locale: letters are UTF-8 and the picture is the same
// whatever the user's is. The C library itself brings this one, so it is there in a bare container.
std::vector<std::string> environment_of_child() {
  constexpr std::string_view kLocale = "LC_ALL=";
  std::vector<std::string> variables = {std::string(kLocale) + "C.UTF-8"};
  for (char** variable = environ; *variable != nullptr; ++variable) {
    if (!std::string_view(*variable).starts_with(kLocale)) variables.emplace_back(*variable);
  }
  return variables;
}

// As exec() takes a list; it lives as long as the words do.
std::vector<char*> pointers_to(std::vector<std::string>* words) {
  std::vector<char*> pointers;
  for (std::string& word : *words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  return pointers;
}

// Starts gnuplot with its output and messages going to the pipe. Returns errno's kind of code.
int spawn(const std::vector<std::string>& arguments, const Pipe& messages, pid_t* child) {
  std::vector<std::string> words = {"gnuplot", "--default-settings"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<std::string> variables = environment_of_child();
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, messages.writer(), STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, messages.writer(), STDERR_FILENO);
  const SpawnAttributes attributes;
  const int code = posix_spawnp(child, "gnuplot", &actions, attributes.get(),
                                pointers_to(&words).data(), pointers_to(&variables).data());
  posix_spawn_file_actions_destroy(&actions);
  return code;
}

void run(const std::vector<std::string>& arguments) {
  constexpr int kNotFoundByShell = 127;
  const std::string not_found =
      "cannot draw: there is no gnuplot on the PATH; install it (Debian, Ubuntu: gnuplot-nox)";
  Pipe messages("gnuplot");
  pid_t child = -1;
  const int code = spawn(arguments, messages, &child);
  if (code == ENOENT) throw RunError(not_found);
  if (code != 0) throw RunError(fmt::format("cannot start gnuplot: {}", std::strerror(code)));
  messages.close_writer();
  const std::string said = messages.read_all();
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFEXITED(status) && WEXITSTATUS(status) == kNotFoundByShell) throw RunError(not_found);
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
    throw RunError(fmt::format("gnuplot failed; it said: {}", said.empty() ? "nothing" : said));
  }
}

}  // namespace

void ensure_gnuplot() { run({"-e", "exit"}); }

void run_gnuplot(const std::string& script, const std::string& picture) {
  std::vector<std::string> arguments = {"-c", plain_path(script)};
  if (!picture.empty()) arguments.push_back(plain_path(picture));
  run(arguments);
}

}  // namespace gearsweep
