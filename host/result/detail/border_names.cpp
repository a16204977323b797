#include "result/detail/border_names.hpp"

#include <algorithm>
#include <array>
#include <string_view>

namespace gearsweep {

std::string variable_of(const std::string& parameter) {
  constexpr std::array<std::string_view, 9> kOwn = {"point",      "state", "section",
                                                    "multiplier", "angle", "stable",
                                                    "residual",   "side",  "parameter"};
  const bool is_taken = std::ranges::find(kOwn, parameter) != kOwn.end() ||
                        parameter.starts_with("curve") || parameter.starts_with("special") ||
                        parameter.starts_with("border") || parameter.starts_with("multiplier_") ||
                        parameter.starts_with("state_");
  return is_taken ? "parameter_" + parameter : parameter;
}

}  // namespace gearsweep
