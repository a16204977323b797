#include "result/detail/file_names.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "study/draw_quantities.hpp"

namespace gearsweep {
namespace {

// Variables and dimensions that write_result() makes beside those of the axes.
bool is_taken_in_result(const std::string& name, const Study& study) {
  const std::vector<Quantity>& quantities = study.selection.quantities;
  return name == "status" || name == kPointAxis || name == "poincare" || name == "sample" ||
         name.starts_with("state") || name.starts_with("attractor_") ||
         (study.uncertain.keep &&
          (name.starts_with(kUncertainDimension) || name.starts_with(kDrawDimension))) ||
         std::any_of(quantities.begin(), quantities.end(), [&](const Quantity& quantity) {
           const std::string& dimension = quantity.dimension;
           return name == quantity.name || (!dimension.empty() && name.starts_with(dimension));
         });
}

// Whether write_traces() has a variable of this name.
bool is_taken_in_traces(const std::string& name, const std::vector<ChannelInfo>& channels) {
  constexpr std::array<std::string_view, 9> kOwn = {"trace",       "moment",     "label",
                                                    "label_width", "period",     "settled",
                                                    "tau",         kMeshPeriods, kClockless};
  return std::find(kOwn.begin(), kOwn.end(), name) != kOwn.end() ||
         std::any_of(channels.begin(), channels.end(),
                     [&](const ChannelInfo& channel) { return name == channel.name; });
}

}  // namespace

std::string name_in_result(const Swept& swept, const Study& study) {
  if (!is_taken_in_result(swept.name, study)) return swept.name;
  return (swept.is_state ? "initial_" : "parameter_") + swept.name;
}

std::string name_in_traces(const std::string& parameter, const std::vector<ChannelInfo>& channels) {
  return is_taken_in_traces(parameter, channels) ? "parameter_" + parameter : parameter;
}

}  // namespace gearsweep
