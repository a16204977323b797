#include "study/detail/swept_name.hpp"

#include <fmt/format.h>

#include "model/names.hpp"
#include "study/detail/toml_access.hpp"
#include "study/study_keys.hpp"

namespace gearsweep {

std::pair<double, double> bind_swept(const Model& model, const toml::node& place,
                                     const std::string& what, Swept* swept) {
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
  std::vector<std::string> known;
  for (const ParameterInfo& info : model.parameters) known.push_back(info.name);
  for (const ChannelInfo& info : model.states) known.push_back(info.name);
  fail_at(place, fmt::format("{} '{}' is neither a parameter nor a state of model '{}'{}", what,
                             swept->name, model.name, suggest_name(swept->name, known)));
}

}  // namespace gearsweep
