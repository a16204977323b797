#include "plot/detail/gnuplot.hpp"

#include <fmt/format.h>

#include <vector>

#include "model/error.hpp"
#include "model/plain_path.hpp"
#include "result/child_program.hpp"

namespace gearsweep {
namespace {

void run(const std::vector<std::string>& arguments) {
  std::vector<std::string> words = {"gnuplot", "--default-settings"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  // Letters are UTF-8 and the picture is the same whatever the user's locale is. The C library
  // itself brings this one, so it is there in a bare container.
  const ChildEnd end = run_child(words, {"LC_ALL=C.UTF-8"}, 0.0, "gnuplot");
  if (!end.is_found) {
    throw RunError(
        "cannot draw: there is no gnuplot on the PATH; install it (Debian, Ubuntu: gnuplot-nox), "
        "or "
        "plot the result in Python, which needs matplotlib");
  }
  if (!end.is_well) {
    throw RunError(
        fmt::format("gnuplot failed; it said: {}", end.said.empty() ? "nothing" : end.said));
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
