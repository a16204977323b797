// A thin owner of an open NetCDF file, with errors as exceptions.
#pragma once

#include <netcdf.h>

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "result/dataset.hpp"

namespace gearsweep {

// Ids of variables and dimensions are those of the NetCDF library. Unless said otherwise, functions
// throw what was being done, the file, the library's reason: InputError of a file that was opened
// for reading, where the disk is not to blame; else RunError.
class NetcdfFile {
 public:
  // Creates a NetCDF-4 file over whatever is at `path`. Messages call it `shown_name`.
  static NetcdfFile create(const std::string& path, const std::string& shown_name);
  // Opens for reading. Throws InputError when there is no such file or it is not NetCDF.
  static NetcdfFile open(const std::string& path);
  ~NetcdfFile();
  NetcdfFile(NetcdfFile&& other) noexcept;
  NetcdfFile& operator=(NetcdfFile&&) = delete;

  int id() const { return id_; }
  const std::string& name() const { return shown_name_; }
  // doing: "define the variable 'x1_rms'".
  void check(int code, std::string_view doing) const;
  // Writes all that is still in memory; nothing may be called after.
  void close();

  int define_dimension(const std::string& dimension, std::size_t size);
  int define_variable(const std::string& variable, nc_type type,
                      const std::vector<int>& dimensions);
  // `variable` may be NC_GLOBAL.
  void put_attribute(int variable, const std::string& attribute, const std::string& text);
  void put_attribute(int variable, const std::string& attribute, double number);
  void put_attribute(int variable, const std::string& attribute, float number);
  void put_attribute(int variable, const std::string& attribute,
                     const std::vector<signed char>& numbers);
  void put_attributes(int variable, const std::vector<Attribute>& attributes);

  void compress(int variable);
  // A block of a variable; start and count have one entry per dimension.
  void put(int variable, const std::vector<std::size_t>& start,
           const std::vector<std::size_t>& count, std::span<const double> values);
  void put(int variable, const std::vector<std::size_t>& start,
           const std::vector<std::size_t>& count, std::span<const float> values);
  void put(int variable, const std::vector<std::size_t>& start,
           const std::vector<std::size_t>& count, std::span<const signed char> values);
  void put_text(int variable, const std::vector<std::size_t>& start,
                const std::vector<std::size_t>& count, std::string_view text);

  std::vector<std::string> variables() const;
  std::string variable_name(int variable) const;
  // -1 when there is none of that name.
  int find_variable(const std::string& variable) const;
  std::vector<int> dimensions_of(int variable) const;
  std::string dimension_name(int dimension) const;
  std::size_t dimension_size(int dimension) const;
  std::optional<std::string> text_attribute(int variable, const std::string& attribute) const;
  // Empty when there is none.
  std::vector<double> number_attribute(int variable, const std::string& attribute) const;
  // A block of a variable of any numeric type; start and count have one entry per dimension. Throws
  // InputError when they do not, or when a file of this size cannot hold so much.
  std::vector<double> read(int variable, const std::vector<std::size_t>& start,
                           const std::vector<std::size_t>& count) const;
  // A character array [entry][width]; trailing zeros and blanks are not part of an entry. Throws
  // InputError as read does, or when there are more or longer ones than anyone can read.
  std::vector<std::string> read_texts(int variable) const;

 private:
  NetcdfFile(int id, std::string shown_name) : id_(id), shown_name_(std::move(shown_name)) {}

  void refuse_too_large(int variable) const;

  int id_ = -1;
  std::string shown_name_;
  double bytes_ = 0.0;  // of the file, when it was opened for reading
};

}  // namespace gearsweep
