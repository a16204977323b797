// What every NetCDF file of this program says of itself and of its variables.
#pragma once

#include <string>
#include <vector>

#include "result/detail/netcdf_file.hpp"
#include "result/result_file.hpp"
#include "result/si_units.hpp"
#include "study/study.hpp"

namespace gearsweep {

// Writes the attributes of one file.
class FileNotes {
 public:
  // varied: parameters that differ between the numbers of the file.
  FileNotes(const Study& study, const std::vector<std::string>& varied, NetcdfFile* file);

  // Study, program and, of a study with a [gear] table, its scales.
  void put_provenance(const Provenance& provenance);

  // `units`, `long_name` and, of a study with a [gear] table, `scale_to_SI` and `SI_units` where
  // the unit has a dimension. Empty is the unit "1".
  void describe(int variable, const std::string& unit, const std::string& meaning);

  // A variable whose values stand along a dimension of channels: their unit where it is one, else
  // "see LIST_units".
  void describe(int variable, const std::vector<ChannelInfo>& channels, const std::string& list,
                const std::string& meaning);

  // Lists over a dimension of channels: LIST_units, LIST_long_name and, of a study with a [gear]
  // table, LIST_scale_to_SI and LIST_SI_units.
  void put_channels(const std::vector<ChannelInfo>& channels, const std::string& list,
                    int dimension);

  // A list of texts, as characters and not as NetCDF-4 strings: every reader knows those.
  void put_texts(const std::string& variable, const std::string& meaning, int dimension,
                 const std::vector<std::string>& texts);

  // The names of the lists of put_channels().
  std::vector<std::string> lists_of_channels(const std::string& list) const;

 private:
  SiUnit si_of(const std::string& unit) const;  // the unit 1 where it has no dimension

  const Study& study_;
  NetcdfFile& file_;
  double damping_ = 0.0;  // the unit cm in N s/m; 0: none, or not the same everywhere
};

// Unit of dimensionless time: "1/varpi" of a gear, "1" of a model without scales.
std::string time_unit(const Model& model);

}  // namespace gearsweep
