// Meshes of gears, by the frequencies at which they excite.
#pragma once

#include <string>
#include <vector>

#include "model/model.hpp"

namespace gearsweep {

struct ExcitingMesh {
  std::string name;    // of its drawing; empty where there is one mesh
  double order = 1.0;  // its frequency over that of the phase
};

// That of the phase first. Several that have one frequency are one.
std::vector<ExcitingMesh> exciting_meshes(const Model& model, const ModelSetting& setting);

}  // namespace gearsweep
