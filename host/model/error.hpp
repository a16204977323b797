// The two ways in which the tool fails, by who can mend it.
#pragma once

#include <stdexcept>
#include <string>

namespace gearsweep {

// The input was wrong: the message says where, what is wrong and what would be right (exit status
// 2).
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Something failed while running: the message says what was being done and why it failed (exit
// status 1).
class RunError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace gearsweep
