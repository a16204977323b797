// Everything that gearsweep does with a file that it is given as a result.
#pragma once

#include <string>

namespace gearsweep::testing {

// Throws nothing that says what is wrong with the file.
void read_all_of(const std::string& path);

}  // namespace gearsweep::testing
