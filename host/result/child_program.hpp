// Another program, started without a shell.
#pragma once

#include <string>
#include <vector>

namespace gearsweep {

// How a program ended.
struct ChildEnd {
  bool is_found = true;    // false: no such program on the PATH
  bool is_in_time = true;  // false: it was killed
  bool is_well = false;    // it ended by itself, with status 0
  std::string said;        // on its standard output and error
};

// Runs words.front(), found on the PATH, with the other words as arguments, and waits for its end.
// It reads nothing; signals do to it what they do by themselves. variables: "NAME=value", in place
// of the environment's own. seconds: after which it is killed with all that it started; 0: never.
// `name` is what messages call it. Throws RunError when it is there and cannot be started.
ChildEnd run_child(std::vector<std::string> words, const std::vector<std::string>& variables,
                   double seconds, const std::string& name);

}  // namespace gearsweep
