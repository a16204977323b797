#include "model/regular_file.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <system_error>

#include "model/error.hpp"

namespace gearsweep {
namespace {

using std::filesystem::file_type;

const char* name_of(file_type type) {
  switch (type) {
    case file_type::directory:
      return "a folder";
    case file_type::fifo:
      return "a pipe";
    case file_type::socket:
      return "a socket";
    default:
      return "a device";
  }
}

}  // namespace

bool has_regular_file(const std::string& path, const std::string& role) {
  std::error_code error;
  const file_type type = std::filesystem::status(path, error).type();
  if (type == file_type::regular) return true;
  if (type == file_type::not_found) return false;
  if (error) throw InputError(fmt::format("'{}' cannot be opened: {}", path, error.message()));
  throw InputError(fmt::format("'{}' is {}; {} must be a regular file", path, name_of(type), role));
}

}  // namespace gearsweep
