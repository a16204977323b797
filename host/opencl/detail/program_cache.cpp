#include "opencl/detail/program_cache.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <span>
#include <sstream>
#include <string_view>
#include <system_error>
#include <vector>

#include "model/checksum.hpp"
#include "opencl/detail/program.hpp"

namespace gearsweep {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxPrograms = 64;
constexpr std::string_view kSuffix = ".gearsweep-program";  // an unfinished file's name goes on
constexpr std::size_t kHashDigits = 16;

std::string hash_of(std::string_view text) {
  Checksum checksum;
  checksum.add(std::as_bytes(std::span(text)));
  return fmt::format("{:0{}x}", checksum.value(), kHashDigits);
}

// All that decides what the device compiler makes, the source last.
std::string key_of(const cl::Device& device, const std::string& source,
                   const std::string& options) {
  const cl::Platform platform(device.getInfo<CL_DEVICE_PLATFORM>());
  std::string key;
  for (const std::string& part :
       {platform.getInfo<CL_PLATFORM_NAME>(), platform.getInfo<CL_PLATFORM_VERSION>(),
        device.getInfo<CL_DEVICE_VENDOR>(), device.getInfo<CL_DEVICE_NAME>(),
        device.getInfo<CL_DEVICE_VERSION>(), device.getInfo<CL_DRIVER_VERSION>(), options}) {
    key += part + '\n';
  }
  return key + source;
}

// What an entry begins with, before its binary. It holds the whole key: two keys of one hash only
// push each other out. The binary's hash tells a damaged entry, which a driver may not survive.
std::string header_of(const std::string& key, std::string_view binary) {
  return fmt::format("gearsweep program 1\n{} {}\n{}\n", hash_of(binary), key.size(), key);
}

std::optional<std::vector<unsigned char>> read_entry(const fs::path& path, const std::string& key) {
  std::ostringstream content;
  content << std::ifstream(path, std::ios::binary).rdbuf();  // nothing when it cannot be read
  const std::string text = content.str();
  const std::size_t start = header_of(key, "").size();  // every header of a key is as long
  if (text.size() <= start) return std::nullopt;
  const std::string_view binary = std::string_view(text).substr(start);
  if (!text.starts_with(header_of(key, binary))) return std::nullopt;
  std::error_code ignored;
  fs::last_write_time(path, fs::file_time_type::clock::now(), ignored);  // the last one used
  return std::vector<unsigned char>(binary.begin(), binary.end());
}

// Whether a file is an entry, or was to become one when its writer was killed.
bool is_ours(const std::string& name) { return name.find(kSuffix) == kHashDigits; }

void remove_oldest(const fs::path& folder) {
  std::vector<std::pair<fs::file_time_type, fs::path>> entries;
  std::error_code error;
  for (fs::directory_iterator i(folder, error), end; !error && i != end; i.increment(error)) {
    if (!is_ours(i->path().filename().string())) continue;
    std::error_code gone;  // another process may be tidying up, too
    const fs::file_time_type time = i->last_write_time(gone);
    if (!gone) entries.emplace_back(time, i->path());
  }
  std::sort(entries.begin(), entries.end());
  for (std::size_t i = 0; i + kMaxPrograms < entries.size(); ++i) {
    fs::remove(entries[i].second, error);
  }
}

// Under another name first: nobody ever sees half an entry.
void write_entry(const fs::path& path, const std::string& key, std::string_view binary) {
  std::error_code error;
  fs::create_directories(path.parent_path(), error);
  std::string unfinished = path.string() + ".XXXXXX";
  const int file = mkstemp(unfinished.data());
  if (file < 0) return;
  close(file);
  std::ofstream out(unfinished, std::ios::binary);
  out << header_of(key, binary) << binary;
  out.close();
  if (out) fs::rename(unfinished, path, error);
  if (!out || error) {
    fs::remove(unfinished, error);
    return;
  }
  remove_oldest(path.parent_path());
}

// Nothing when the device refuses the binary.
std::optional<cl::Program> load(const cl::Context& context, const cl::Device& device,
                                const std::vector<unsigned char>& binary,
                                const std::string& options) {
  try {
    cl::Program program(context, {device}, {binary});
    program.build({device}, options.c_str());
    return program;
  } catch (const cl::Error&) {
    return std::nullopt;
  }
}

void keep(const cl::Program& program, const fs::path& path, const std::string& key) {
  try {
    const std::vector<std::vector<unsigned char>> binaries = program.getInfo<CL_PROGRAM_BINARIES>();
    if (binaries.size() != 1 || binaries.front().empty()) return;
    const std::string binary(binaries.front().begin(), binaries.front().end());
    write_entry(path, key, binary);
  } catch (const cl::Error&) {
    return;  // a device need not give its binaries
  }
}

// PoCL keeps compiled kernels, so that a known program starts fast without ours, too. Measured with
// PoCL 3.1: ours saves another 0.03 s of processor time at each start, but to be asked for a binary
// makes PoCL compile each kernel once more, for any local size, which takes 1 to 3 s.
bool keeps_kernels_itself(const std::string& platform) {
  return platform == "Portable Computing Language";
}

}  // namespace

fs::path program_cache_folder(const std::string& platform) {
  if (const char* folder = std::getenv("GEARSWEEP_CACHE_DIR")) return folder;
  if (keeps_kernels_itself(platform)) return {};
  const char* caches = std::getenv("XDG_CACHE_HOME");
  if (caches != nullptr && fs::path(caches).is_absolute()) return fs::path(caches) / "gearsweep";
  const char* home = std::getenv("HOME");
  if (home == nullptr || !fs::path(home).is_absolute()) return {};
  return fs::path(home) / ".cache" / "gearsweep";
}

cl::Program cached_program(const cl::Context& context, const cl::Device& device,
                           const std::string& source, const std::string& options,
                           const fs::path& folder) {
  if (folder.empty()) return build_program(context, device, source, options);
  const std::string key = key_of(device, source, options);
  const fs::path path = folder / (hash_of(key) + std::string(kSuffix));
  if (const std::optional<std::vector<unsigned char>> binary = read_entry(path, key)) {
    if (const std::optional<cl::Program> program = load(context, device, *binary, options)) {
      return *program;
    }
  }
  cl::Program program = build_program(context, device, source, options);
  keep(program, path, key);
  return program;
}

}  // namespace gearsweep
