#include "plot/band.hpp"

#include <fmt/format.h>

#include <map>

#include "study/draw_quantities.hpp"

namespace gearsweep {

std::optional<BandMaps> band_maps(const std::string& quantity,
                                  const std::vector<std::string>& names) {
  std::map<double, std::string> percentiles;
  for (const std::string& name : names) {
    if (const std::optional<double> percentile = percentile_in(name, quantity)) {
      percentiles[*percentile] = name;
    }
  }
  if (percentiles.size() < 2) return std::nullopt;
  const auto &lowest = *percentiles.begin(), &highest = *percentiles.rbegin();
  BandMaps maps = {lowest.second, highest.second, {}, {}};
  if (const auto median = percentiles.find(50.0); median != percentiles.end()) {
    maps.median = median->second;
  }
  maps.meaning = fmt::format("percentiles {:g} to {:g}", lowest.first, highest.first);
  return maps;
}

}  // namespace gearsweep
