// Runs the gearsweep program as a user does.
#pragma once

#include <sys/wait.h>

#include <cstdlib>
#include <string>

#include "support/folder.hpp"

namespace gearsweep::testing {

struct Outcome {
  int status = 0;
  std::string out, err;
};

// Runs a shell command in a folder.
inline Outcome run_in(const Folder& folder, const std::string& command) {
  const Folder log;
  const std::string line = "cd '" + folder.path().string() + "' && " + command + " > '" +
                           (log / "out").string() + "' 2> '" + (log / "err").string() + "'";
  const int status = std::system(line.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_all(log / "out"),
          read_all(log / "err")};
}

// Runs the program that was built with these tests: "run study.toml -o out.nc".
inline Outcome gearsweep(const Folder& folder, const std::string& arguments) {
  return run_in(folder, std::string(GEARSWEEP_BINARY) + " " + arguments);
}

}  // namespace gearsweep::testing
