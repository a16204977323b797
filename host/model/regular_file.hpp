// Files that a user names to be read.
#pragma once

#include <string>

namespace gearsweep {

// Whether there is a file at `path`. Throws InputError when what is there is no regular file (a
// pipe would be waited for, a device read for ever) or when nobody can tell, as where symbolic
// links lead in a circle. role: what the file is to be, "a study".
bool has_regular_file(const std::string& path, const std::string& role);

}  // namespace gearsweep
