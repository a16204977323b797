// Universal files, as programs of modal analysis read spectra: dataset 58, "Function at Nodal DOF"
// (its description: Structural Dynamics Research Laboratory, University of Cincinnati).
#pragma once

#include <span>
#include <string>

namespace gearsweep {

// What an axis of a spectrum is. kind: the "specific data type" of the description.
struct UniversalAxis {
  int kind = 0;
  std::string label, unit;
};
inline constexpr int kUnknownKind = 0, kRpmKind = 19, kOrderKind = 20;

// A spectrum at one place of an order map.
struct UniversalSpectrum {
  std::string title, subtitle;
  double first = 0.0, increment = 0.0;  // of the abscissa, which is even
  double place = 0.0;                   // on the third axis
  UniversalAxis abscissa, ordinate, third;
  std::span<const double> values;  // finite
};

// One dataset, in ASCII and double precision. number: of the function, from 1. Letters that ASCII
// lacks become '?', the micro sign 'u'; labels are cut at 20 letters, titles at 80.
std::string universal_dataset(const UniversalSpectrum& spectrum, std::size_t number);

}  // namespace gearsweep
