#include "opencl/pocl_cache.hpp"

#include <unistd.h>

#include <cstdlib>
#include <string>
#include <system_error>

namespace gearsweep {
namespace {

namespace fs = std::filesystem;

// Empty when it is not set.
std::string environment(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

}  // namespace

fs::path pocl_cache_folder() {
  const std::string own = environment("POCL_CACHE_DIR");
  if (!own.empty()) return own;
  const std::string caches = environment("XDG_CACHE_HOME");
  if (!caches.empty()) return fs::path(caches) / "pocl" / "kcache";
  const std::string home = environment("HOME");
  if (!home.empty()) return fs::path(home) / ".cache" / "pocl" / "kcache";
  return "/tmp/pocl/kcache";
}

bool can_write_in(const fs::path& folder) {
  std::error_code error;
  fs::path there = fs::absolute(folder, error);
  while (fs::status(there, error).type() == fs::file_type::not_found && there.has_relative_path()) {
    there = there.parent_path();
  }
  // Permissions alone do not tell: the superuser has them everywhere.
  std::string trial = (there / "gearsweep-XXXXXX").string();
  if (mkdtemp(trial.data()) == nullptr) return false;
  rmdir(trial.c_str());
  return true;
}

}  // namespace gearsweep
