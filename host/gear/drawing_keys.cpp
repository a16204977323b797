#include "gear/drawing_keys.hpp"

#include <utility>

namespace gearsweep {

std::string GearKey::unit() const {
  // The longer one stands first: it is taken where two fit.
  static constexpr std::pair<std::string_view, std::string_view> kWritten[] = {
      {"_N_s_per_mm", "N s/mm"},
      {"_N_per_mm", "N/mm"},
      {"_N_per_m", "N/m"},
      {"_kg_mm2", "kg mm^2"},
      {"_N_m", "N m"},
      {"_mm", "mm"},
      {"_deg", "degrees"},
      {"_kg", "kg"},
      {"_um", "um"},
      {"_rpm", "rpm"}};
  for (const auto& [ending, written] : kWritten) {
    if (name.ends_with(ending)) return std::string(written);
  }
  return "1";
}

}  // namespace gearsweep
