// What every NetCDF file of this program says of itself and of its variables.
#pragma once

#include <string>
#include <vector>

#include "result/dataset.hpp"
#include "result/result_file.hpp"
#include "result/si_units.hpp"
#include "study/study.hpp"

namespace gearsweep {

// The attribute `content` of files of traces.
inline constexpr const char* kContentOfTraces = "traces of gearsweep";

// Makes the attributes of one file.
class FileNotes {
 public:
  // varied: parameters that differ between the numbers of the file.
  FileNotes(const Study& study, const std::vector<std::string>& varied);

  // Study, program and, of a study with a [gear] table, its scales.
  std::vector<Attribute> provenance(const Provenance& provenance) const;

  // `units`, `long_name` and, of a study with a [gear] table, `scale_to_SI` and `SI_units` where
  // the unit has a dimension. Empty is the unit "1".
  std::vector<Attribute> describe(const std::string& unit, const std::string& meaning) const;

  // Describes a variable whose values stand along a dimension of channels: their unit where it is
  // one, else "see LIST_units".
  std::vector<Attribute> describe(const std::vector<ChannelInfo>& channels, const std::string& list,
                                  const std::string& meaning) const;

  // Adds lists over a dimension of channels: LIST_units, LIST_long_name and, of a study with a
  // [gear] table, LIST_scale_to_SI and LIST_SI_units.
  void add_channels(const std::vector<ChannelInfo>& channels, const std::string& list,
                    const std::string& dimension, Dataset* out) const;

 private:
  SiUnit si_of(const std::string& unit) const;  // the unit 1 where it has no dimension

  // The names of the lists of add_channels().
  std::vector<std::string> lists_of_channels(const std::string& list) const;

  const Study& study_;
  double damping_ = 0.0;  // the unit cm in N s/m; 0: none, or not the same everywhere
};

// Adds a list of texts, as characters and not as NetCDF-4 strings: every reader knows those.
void add_texts(const std::string& variable, const std::string& meaning,
               const std::string& dimension, const std::vector<std::string>& texts, Dataset* out);

// Adds what the classes 0, 1, 2, ... of a variable are called, or those of these codes.
void add_flags(const std::vector<std::string>& names, std::vector<Attribute>* attributes);
void add_flags(const std::vector<signed char>& codes, const std::vector<std::string>& names,
               std::vector<Attribute>* attributes);

// Unit of dimensionless time: "1/varpi" of a gear, "1" of a model without scales.
std::string time_unit(const Model& model);

}  // namespace gearsweep
