// Paths as other programs take them for nothing but paths.
#pragma once

#include <string>

namespace gearsweep {

// The same file by a path that begins with '/' or './'. Otherwise a name of a stranger's choice may
// begin as something else does: a command (gnuplot: "|..." and "<..."), a home ("~..."), an option
// ("-..."), an address (NetCDF: "http:...", "[...]..."; SQLite: "file:..."). Empty stays empty.
inline std::string plain_path(const std::string& path) {
  return path.empty() || path.front() == '/' ? path : "./" + path;
}

}  // namespace gearsweep
