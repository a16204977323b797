#include "result/detail/netcdf_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <numeric>
#include <system_error>
#include <utility>

#include "model/error.hpp"
#include "model/plain_path.hpp"
#include "result/result_file.hpp"

namespace gearsweep {

namespace {

bool is_of_disk(int reason) {
  return reason == ENOSPC || reason == EDQUOT || reason == EFBIG || reason == EIO ||
         reason == EROFS;
}

// "HDF error" alone does not say what to do, and a file that cannot be created is said to be one
// without permission: the system's reason, where it is one of the disk's.
std::string reason_of(int code) {
  const int reason = errno;
  const bool may_hide_it = code == NC_EHDFERR || code == EACCES;
  return may_hide_it && is_of_disk(reason) ? std::generic_category().message(reason)
                                           : fmt::format("{} ({})", nc_strerror(code), code);
}

// What the NetCDF library is given for the path of a file that is there. It takes a backslash for a
// slash on every system, so that it would go into another folder.
class LibraryPath {
 public:
  explicit LibraryPath(const std::string& path) : path_(plain_path(path)) {
    if (path.find('\\') == std::string::npos) return;
    descriptor_ = ::open(path.c_str(), O_PATH | O_CLOEXEC);
    if (descriptor_ >= 0) path_ = fmt::format("/proc/self/fd/{}", descriptor_);
  }
  ~LibraryPath() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  LibraryPath(const LibraryPath&) = delete;
  LibraryPath& operator=(const LibraryPath&) = delete;

  const char* c_str() const { return path_.c_str(); }

 private:
  std::string path_;
  int descriptor_ = -1;
};

}  // namespace

NetcdfFile NetcdfFile::create(const std::string& path, const std::string& shown_name) {
  int id = -1;
  const LibraryPath library_path(path);
  errno = 0;
  const int code = nc_create(library_path.c_str(), NC_NETCDF4 | NC_CLOBBER, &id);
  NetcdfFile file(code == NC_NOERR ? id : -1, shown_name);
  file.check(code, "write the first data");
  return file;
}

NetcdfFile NetcdfFile::open(const std::string& path) {
  if (!is_netcdf(path)) {
    const bool readable = std::ifstream(path).good();
    throw InputError(readable
                         ? fmt::format("'{}' is not a NetCDF file; give a result that "
                                       "gearsweep wrote",
                                       path)
                         : fmt::format("cannot open '{}'; give an existing result file", path));
  }
  int id = -1;
  const int code = nc_open(LibraryPath(path).c_str(), NC_NOWRITE, &id);
  if (code != NC_NOERR) {
    throw InputError(
        fmt::format("'{}' looks like a NetCDF file but cannot be opened ({}); it may "
                    "be cut short",
                    path, nc_strerror(code)));
  }
  NetcdfFile file(id, path);
  std::error_code error;
  const std::uintmax_t bytes = std::filesystem::file_size(path, error);
  if (!error) file.bytes_ = static_cast<double>(bytes);
  return file;
}

NetcdfFile::~NetcdfFile() {
  if (id_ >= 0) nc_close(id_);
}

NetcdfFile::NetcdfFile(NetcdfFile&& other) noexcept
    : id_(std::exchange(other.id_, -1)),
      shown_name_(std::move(other.shown_name_)),
      bytes_(other.bytes_) {}

void NetcdfFile::check(int code, std::string_view doing) const {
  if (code == NC_NOERR) return;
  const int reason = errno;
  if (bytes_ > 0.0 && !is_of_disk(reason)) {
    throw InputError(
        fmt::format("cannot {} in '{}': {}; the file is damaged, or of another program", doing,
                    shown_name_, reason_of(code)));
  }
  errno = reason;
  throw RunError(fmt::format("cannot {} in '{}': {}", doing, shown_name_, reason_of(code)));
}

void NetcdfFile::close() { check(nc_close(std::exchange(id_, -1)), "write the last data"); }

int NetcdfFile::define_dimension(const std::string& dimension, std::size_t size) {
  int made = -1;
  check(nc_def_dim(id_, dimension.c_str(), size, &made),
        fmt::format("define the dimension '{}'", dimension));
  return made;
}

int NetcdfFile::define_variable(const std::string& variable, nc_type type,
                                const std::vector<int>& dimensions) {
  int made = -1;
  check(nc_def_var(id_, variable.c_str(), type, static_cast<int>(dimensions.size()),
                   dimensions.data(), &made),
        fmt::format("define the variable '{}'", variable));
  return made;
}

void NetcdfFile::put_attribute(int variable, const std::string& attribute,
                               const std::string& text) {
  check(nc_put_att_text(id_, variable, attribute.c_str(), text.size(), text.data()),
        fmt::format("write the attribute '{}'", attribute));
}

void NetcdfFile::put_attribute(int variable, const std::string& attribute, double number) {
  check(nc_put_att_double(id_, variable, attribute.c_str(), NC_DOUBLE, 1, &number),
        fmt::format("write the attribute '{}'", attribute));
}

void NetcdfFile::put_attribute(int variable, const std::string& attribute, float number) {
  check(nc_put_att_float(id_, variable, attribute.c_str(), NC_FLOAT, 1, &number),
        fmt::format("write the attribute '{}'", attribute));
}

void NetcdfFile::put_attribute(int variable, const std::string& attribute,
                               const std::vector<signed char>& numbers) {
  check(nc_put_att_schar(id_, variable, attribute.c_str(), NC_BYTE, numbers.size(), numbers.data()),
        fmt::format("write the attribute '{}'", attribute));
}

void NetcdfFile::put_attributes(int variable, const std::vector<Attribute>& attributes) {
  for (const Attribute& attribute : attributes) {
    std::visit([&](const auto& value) { put_attribute(variable, attribute.name, value); },
               attribute.value);
  }
}

void NetcdfFile::compress(int variable) {
  constexpr int kShuffle = 1, kDeflate = 1, kLevel = 1;
  check(nc_def_var_deflate(id_, variable, kShuffle, kDeflate, kLevel),
        fmt::format("compress the variable '{}'", variable_name(variable)));
}

void NetcdfFile::put(int variable, const std::vector<std::size_t>& start,
                     const std::vector<std::size_t>& count, std::span<const double> values) {
  check(nc_put_vara_double(id_, variable, start.data(), count.data(), values.data()),
        fmt::format("write the variable '{}'", variable_name(variable)));
}

void NetcdfFile::put(int variable, const std::vector<std::size_t>& start,
                     const std::vector<std::size_t>& count, std::span<const float> values) {
  check(nc_put_vara_float(id_, variable, start.data(), count.data(), values.data()),
        fmt::format("write the variable '{}'", variable_name(variable)));
}

void NetcdfFile::put(int variable, const std::vector<std::size_t>& start,
                     const std::vector<std::size_t>& count, std::span<const signed char> values) {
  check(nc_put_vara_schar(id_, variable, start.data(), count.data(), values.data()),
        fmt::format("write the variable '{}'", variable_name(variable)));
}

void NetcdfFile::put_text(int variable, const std::vector<std::size_t>& start,
                          const std::vector<std::size_t>& count, std::string_view text) {
  check(nc_put_vara_text(id_, variable, start.data(), count.data(), text.data()),
        fmt::format("write the variable '{}'", variable_name(variable)));
}

std::vector<std::string> NetcdfFile::variables() const {
  int count = 0;
  check(nc_inq_nvars(id_, &count), "count the variables");
  std::vector<std::string> names;
  for (int variable = 0; variable < count; ++variable) names.push_back(variable_name(variable));
  return names;
}

std::string NetcdfFile::variable_name(int variable) const {
  std::array<char, NC_MAX_NAME + 1> name{};
  check(nc_inq_varname(id_, variable, name.data()), "read the name of a variable");
  return name.data();
}

int NetcdfFile::find_variable(const std::string& variable) const {
  int found = -1;
  const int code = nc_inq_varid(id_, variable.c_str(), &found);
  if (code == NC_ENOTVAR) return -1;
  check(code, fmt::format("find the variable '{}'", variable));
  return found;
}

std::vector<int> NetcdfFile::dimensions_of(int variable) const {
  int count = 0;
  check(nc_inq_varndims(id_, variable, &count), "count the dimensions of a variable");
  std::vector<int> dimensions(static_cast<std::size_t>(count));
  check(nc_inq_vardimid(id_, variable, dimensions.data()), "read the dimensions of a variable");
  return dimensions;
}

std::string NetcdfFile::dimension_name(int dimension) const {
  std::array<char, NC_MAX_NAME + 1> name{};
  check(nc_inq_dimname(id_, dimension, name.data()), "read the name of a dimension");
  return name.data();
}

std::size_t NetcdfFile::dimension_size(int dimension) const {
  std::size_t size = 0;
  check(nc_inq_dimlen(id_, dimension, &size), "read the size of a dimension");
  return size;
}

std::optional<std::string> NetcdfFile::text_attribute(int variable,
                                                      const std::string& attribute) const {
  nc_type type = NC_NAT;
  std::size_t length = 0;
  const int code = nc_inq_att(id_, variable, attribute.c_str(), &type, &length);
  if (code == NC_ENOTATT) return std::nullopt;
  const std::string doing = fmt::format("read the attribute '{}'", attribute);
  check(code, doing);
  // Other programs that copy a file may turn the text into a NetCDF-4 string.
  if (type == NC_STRING && length == 1) {
    char* stored = nullptr;
    check(nc_get_att_string(id_, variable, attribute.c_str(), &stored), doing);
    std::string text = stored == nullptr ? "" : stored;
    nc_free_string(1, &stored);
    return text;
  }
  if (type != NC_CHAR) return std::nullopt;
  std::string text(length, '\0');
  check(nc_get_att_text(id_, variable, attribute.c_str(), text.data()), doing);
  return text;
}

std::vector<double> NetcdfFile::number_attribute(int variable, const std::string& attribute) const {
  nc_type type = NC_NAT;
  std::size_t length = 0;
  const int code = nc_inq_att(id_, variable, attribute.c_str(), &type, &length);
  if (code == NC_ENOTATT || type == NC_CHAR || type == NC_STRING) return {};
  const std::string doing = fmt::format("read the attribute '{}'", attribute);
  check(code, doing);
  std::vector<double> numbers(length);
  check(nc_get_att_double(id_, variable, attribute.c_str(), numbers.data()), doing);
  return numbers;
}

// A few bytes can claim any size for what was never written; what was written cannot have been
// deflated further than this.
void NetcdfFile::refuse_too_large(int variable) const {
  constexpr double kMaxDeflation = 1100.0;
  nc_type type = NC_NAT;
  std::size_t width = 0;
  check(nc_inq_vartype(id_, variable, &type), "read the type of a variable");
  check(nc_inq_type(id_, type, nullptr, &width), "read the size of a type");
  auto bytes = static_cast<double>(width);
  for (const int dimension : dimensions_of(variable)) {
    bytes *= static_cast<double>(dimension_size(dimension));
  }
  if (bytes > kMaxDeflation * bytes_) {
    throw InputError(
        fmt::format("'{}' says that '{}' holds {:.3g} bytes, more than a file of {} bytes can",
                    shown_name_, variable_name(variable), bytes, bytes_));
  }
}

std::vector<double> NetcdfFile::read(int variable, const std::vector<std::size_t>& start,
                                     const std::vector<std::size_t>& count) const {
  if (dimensions_of(variable).size() != count.size()) {
    throw InputError(fmt::format("'{}' of '{}' has not the {} dimensions that it should have",
                                 variable_name(variable), shown_name_, count.size()));
  }
  refuse_too_large(variable);
  errno = 0;
  std::vector<double> values(
      std::accumulate(count.begin(), count.end(), std::size_t{1}, std::multiplies<>()));
  check(nc_get_vara_double(id_, variable, start.data(), count.data(), values.data()),
        fmt::format("read the variable '{}'", variable_name(variable)));
  return values;
}

std::vector<std::string> NetcdfFile::read_texts(int variable) const {
  // Names of states, labels of traces: far fewer, and each takes much more memory than in the file.
  constexpr std::size_t kMaxTexts = 10'000, kLongestText = 10'000;
  const std::vector<int> dimensions = dimensions_of(variable);
  if (dimensions.size() != 2) check(NC_EDIMSIZE, "read a list of texts");
  const std::size_t count = dimension_size(dimensions[0]);
  const std::size_t width = dimension_size(dimensions[1]);
  if (count > kMaxTexts || width > kLongestText) {
    throw InputError(
        fmt::format("'{}' says that '{}' holds {} texts of {} characters; no list is "
                    "larger than {} of {}",
                    shown_name_, variable_name(variable), count, width, kMaxTexts, kLongestText));
  }
  refuse_too_large(variable);
  errno = 0;
  std::string all(count * width, '\0');
  check(nc_get_var_text(id_, variable, all.data()), "read a list of texts");
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < count; ++i) {
    std::string text = all.substr(i * width, width);
    text.erase(text.find_last_not_of(std::string(" \0", 2)) + 1);
    texts.push_back(text);
  }
  return texts;
}

}  // namespace gearsweep
