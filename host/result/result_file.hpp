// The result file: the maps of a sweep as NetCDF-4, with the study that made them. Not to be used
// by two threads at once: the NetCDF library cannot be.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/result.hpp"
#include "model/model.hpp"
#include "result/output_file.hpp"

namespace gearsweep {

class NetcdfFile;

// Where a result comes from, beside what the SweepResult knows.
struct Provenance {
  std::string command_line;
  std::string version, source_hash;  // of version.hpp
};

// Writes the file whole or not at all: a failure leaves what was at `path` before. Maps have the
// dimensions (y, x), or (x) with one axis; `poincare` has (y, x, state, sample), a quantity of
// several numbers (y, x, its dimension), such as (y, x, exponent) of a Lyapunov spectrum.
// Throws InputError as ensure_writable does, RunError when the disk or the library fails.
void write_result(const SweepResult& result, const std::string& path, const Provenance& provenance);

// By its first bytes. False when there is no such file.
bool is_netcdf(const std::string& path);

// The TOML of the study that made this file, without the numbers of a list of points. Throws
// InputError when it is not a result file.
std::string read_study_text(const std::string& path);

// The list of points of the study that made this file; empty when it has none.
PointTable read_point_table(const std::string& path);

// The step that the pilot run of an integrate.tolerance found; nothing when there was none. Throws
// InputError.
std::optional<FoundStep> read_pilot_step(const std::string& path);

struct ResultAxis {
  std::string name, unit, meaning;
  std::vector<double> values;
  bool logarithmic = false;
  // What it stands for, where these are several: each as long as its values.
  std::vector<ResultAxis> columns = {};

  bool is_list() const { return name == kPointAxis; }
};

// One quantity over the axes; `unit` is in the model's dimensionless units, "1" without any, or
// where the parts have several.
struct ResultMap {
  std::string name, unit, meaning;
  std::vector<std::string> flags;  // class names when the value is a class, by value
  std::vector<ResultAxis> axes;    // x, then y; a cut takes one away
  std::vector<double> values;      // [point][part][sample]. NaN: no value
  std::string dimension;           // what the parts stand along: "state", "exponent"; may be empty
  std::vector<ChannelInfo> parts;  // states of poincare, exponents "1", ...; empty: one number
  std::size_t samples = 1;         // per point and part; 1 unless poincare

  std::size_t points() const;
  std::size_t part_count() const;  // numbers of a point beside each other; 1 without parts
  bool is_poincare() const;
  bool is_list() const;  // over the points of a list alone
  // Names of its numbers outside of this file: "x1_rms", or "poincare_x1", "poincare_v1".
  std::vector<std::string> column_names() const;
};

// One value of one axis: index into ResultFile::axes() and into that axis's values.
struct Cut {
  std::size_t axis = 0, index = 0;
};

// A result file opened for reading. Functions throw InputError when the file has not what is asked
// for (with the nearest known name), RunError when it cannot be read.
class ResultFile {
 public:
  explicit ResultFile(const std::string& path);
  ~ResultFile();

  const std::string& path() const { return path_; }
  std::string title() const;
  std::string study_text() const;
  // Every value that the study resolved to, as TOML; may be empty.
  std::string settings_text() const;
  // What one dimensionless unit is; unknown without a [gear] table.
  Scales scales() const;
  const std::vector<ResultAxis>& axes() const { return axes_; }
  // In the file's order; `status` and, where it is there, `poincare` included.
  const std::vector<std::string>& quantities() const { return quantities_; }
  // Names of the sampled states; empty without poincare.
  std::vector<std::string> poincare_states() const;
  // The nearest value of an axis. Throws InputError when `value` is beyond the axis.
  Cut find_cut(const std::string& axis, double value) const;
  // quantity: a name of quantities(); "poincare:v1" takes one state, "lyapunov_spectrum:1" one
  // exponent. With a cut, a map of the other axis.
  ResultMap read(const std::string& quantity, const std::optional<Cut>& cut = std::nullopt) const;

 private:
  std::vector<ChannelInfo> read_states() const;
  std::vector<ChannelInfo> read_parts(int variable) const;
  std::vector<std::string> read_part_names(int dimension) const;
  void refuse_unknown(const std::string& quantity) const;

  std::string path_;
  std::unique_ptr<NetcdfFile> file_;
  std::vector<ResultAxis> axes_;
  std::vector<std::string> quantities_;
};

}  // namespace gearsweep
