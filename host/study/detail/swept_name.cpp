#include "study/detail/swept_name.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "model/names.hpp"
#include "study/detail/toml_access.hpp"
#include "study/study_keys.hpp"

namespace gearsweep {

std::pair<double, double> bind_swept(const Model& model, const toml::node& place,
                                     const std::string& what, Swept* swept,
                                     const std::vector<std::string>& keys) {
  if (const int parameter = model.find_parameter(swept->name); parameter >= 0) {
    swept->index = static_cast<std::size_t>(parameter);
    const ParameterInfo& info = model.parameters[swept->index];
    swept->unit = info.unit;
    swept->meaning = info.meaning;
    return {info.min, info.max};
  }
  if (const int state = model.find_state(swept->name); state >= 0) {
    swept->index = static_cast<std::size_t>(state);
    swept->is_state = true;
    swept->unit = model.states[swept->index].unit;
    swept->meaning = "initial " + model.states[swept->index].meaning;
    return {-kMaxState, kMaxState};
  }
  refuse_fixed_constant(model, place, swept->name);
  std::vector<std::string> known = keys;
  for (const ParameterInfo& info : model.parameters) known.push_back(info.name);
  for (const ChannelInfo& info : model.states) known.push_back(info.name);
  fail_at(place, fmt::format("{} '{}' is neither a parameter nor a state of model '{}'{}{}", what,
                             swept->name, model.name, keys.empty() ? "" : ", nor a key of [gear]",
                             suggest_name(swept->name, known)));
}

void refuse_fixed_constant(const Model& model, const toml::node& place, const std::string& name) {
  const auto found = std::ranges::find(model.constants, name, &ConstantInfo::name);
  if (found == model.constants.end()) return;
  fail_at(place, fmt::format("'{}' is a constant of model '{}' that an expression gives; only one "
                             "that is a plain number takes another value",
                             name, model.name));
}

}  // namespace gearsweep
