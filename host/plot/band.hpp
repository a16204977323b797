// The band of tolerances around a curve: which maps of a result it is made of, and how it looks.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace gearsweep {

struct BandMaps {
  std::string low, high;  // names of the maps of the lowest and of the highest percentile
  std::string median;     // of percentile 50; empty where the file has none
  std::string meaning;    // "percentiles 5 to 95"
};

// The band of a quantity, in a result that has maps of these names. Nothing where it has less than
// two percentiles.
std::optional<BandMaps> band_maps(const std::string& quantity,
                                  const std::vector<std::string>& names);

inline constexpr const char* kBandColour = "#c6dff0";
inline constexpr const char* kMedianColour = "#444444";
// What the curve in the band and the thin one are called.
inline constexpr const char* kNominalMeaning = "nominal";
inline constexpr const char* kMedianMeaning = "median";

}  // namespace gearsweep
