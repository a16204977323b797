// What the answers of a load spectrum are in a file.
#pragma once

#include <string>
#include <vector>

#include "result/dataset.hpp"
#include "result/detail/file_notes.hpp"

namespace gearsweep {

// What the loads come to, and what each does of the damage: a map for each force.
struct SpectrumNumbers {
  std::vector<Attribute> attributes;
  std::vector<DataVariable> maps;
};

// For the result of a study with a spectrum. dimensions: those of its maps.
SpectrumNumbers numbers_of_spectrum(const SweepResult& result, const FileNotes& notes,
                                    const std::vector<std::string>& dimensions);

}  // namespace gearsweep
