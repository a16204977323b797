#include "model/model.hpp"

#include <algorithm>

namespace gearsweep {
namespace {

template <class Info>
int index_of(const std::vector<Info>& infos, std::string_view name) {
  for (std::size_t i = 0; i < infos.size(); ++i) {
    if (infos[i].name == name) return static_cast<int>(i);
  }
  return -1;
}

}  // namespace

int Model::find_parameter(std::string_view parameter) const {
  return index_of(parameters, parameter);
}
int Model::find_state(std::string_view state) const { return index_of(states, state); }
int Model::find_signal(std::string_view signal) const { return index_of(signals, signal); }
int Model::find_option(std::string_view option) const { return index_of(options, option); }

std::vector<ContactLimit> Model::contact_limits() const {
  std::vector<ContactLimit> limits;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    limits.push_back({i, 1.0});
    if (!contacts[i].is_one_sided) limits.push_back({i, -1.0});
  }
  for (std::size_t i = 0; i < corners; ++i) limits.push_back({contacts.size() + i, 1.0});
  return limits;
}

const ChannelInfo* Model::contact_force() const {
  const int signal = contacts.empty() ? -1 : find_signal("dmf");
  return signal < 0 ? nullptr : &signals[static_cast<std::size_t>(signal)];
}

std::optional<std::size_t> Model::mean_load() const {
  if (contact_force() == nullptr) return std::nullopt;
  for (const char* const load : {"F1", "Fm"}) {
    const int index = find_parameter(load);
    if (index >= 0) return static_cast<std::size_t>(index);
  }
  return std::nullopt;
}

double Model::mesh_periods(const ModelSetting& setting) const {
  return cycle ? setting.parameters[*cycle] : 1.0;
}

ModelSetting Model::default_setting() const {
  ModelSetting setting;
  for (const ParameterInfo& parameter : parameters) {
    setting.parameters.push_back(parameter.default_value);
  }
  setting.options.assign(options.size(), 0);
  return setting;
}

std::vector<std::string> Model::state_names() const {
  std::vector<std::string> names;
  for (const auto& state : states) names.push_back(state.name);
  return names;
}

Model Model::reduced(const Reduction& to) const {
  Model out = *this;
  out.whole = this;
  out.reduction = to;
  out.states.clear();
  out.angles.clear();
  for (const std::size_t state : to.kept) {
    if (std::ranges::find(angles, state) != angles.end()) out.angles.push_back(out.states.size());
    out.states.push_back(states[state]);
  }
  return out;
}

std::vector<double> Model::own_state(const std::vector<double>& state_of_whole) const {
  if (whole == nullptr) return state_of_whole;
  std::vector<double> own;
  for (const std::size_t state : reduction.kept) own.push_back(state_of_whole[state]);
  return own;
}

}  // namespace gearsweep
