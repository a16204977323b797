#include "cli/small_shell.hpp"

#include <fmt/format.h>

#include <filesystem>

namespace gearsweep::testing {

Outcome run_small(const Folder& folder, const std::string& commands) {
  const std::filesystem::path source = GEARSWEEP_SOURCE;
  const Folder script;
  script.write("commands", commands);
  return run_in(folder, fmt::format("env -i HOME=\"$HOME\" PATH='{}':\"$PATH\" GEARSWEEP='{}' "
                                    "bash -eux '{}'",
                                    (source / "tests/cli/small").string(), GEARSWEEP_BINARY,
                                    (script / "commands").string()));
}

}  // namespace gearsweep::testing
