#include "model/model.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>

#include "model/names.hpp"

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

bool Model::uses_parameter(std::string_view parameter) const {
  return std::ranges::none_of(unused, [&](const UnusedName& one) {
    return one.kind == "parameter" && one.name == parameter;
  });
}

bool Model::is_within_limits(std::span<const double> state) const {
  return std::ranges::equal(state, diverged_above, [](double x, double limit) {
    return std::abs(x) < limit;  // never of what is infinite or no number
  });
}

const DerivedParameter* Model::find_derived(std::size_t parameter) const {
  const auto found = std::ranges::find(derived, parameter, &DerivedParameter::parameter);
  return found == derived.end() ? nullptr : &*found;
}

std::vector<ContactLimit> Model::contact_limits() const {
  std::vector<ContactLimit> limits;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    limits.push_back({i, 1.0});
    if (!contacts[i].is_one_sided) limits.push_back({i, -1.0});
  }
  for (std::size_t i = 0; i < corners; ++i) limits.push_back({contacts.size() + i, 1.0});
  return limits;
}

std::optional<std::size_t> Model::parameter_of(Role role) const {
  const auto found = std::ranges::find(parameters, role, &ParameterInfo::role);
  if (found == parameters.end()) return std::nullopt;
  return static_cast<std::size_t>(found - parameters.begin());
}

std::vector<ChannelInfo> Model::signals_of(Role role) const {
  std::vector<ChannelInfo> found;
  std::ranges::copy_if(signals, std::back_inserter(found),
                       [&](const ChannelInfo& signal) { return signal.role == role; });
  return found;
}

const ChannelInfo* Model::contact_force() const {
  const auto found = std::ranges::find(signals, Role::mesh_force, &ChannelInfo::role);
  return found == signals.end() ? nullptr : &*found;
}

double Model::mesh_periods(const ModelSetting& setting) const {
  return cycle ? cycle(setting) : 1.0;
}

ModelSetting Model::default_setting() const {
  ModelSetting setting;
  for (const ParameterInfo& parameter : parameters) {
    setting.parameters.push_back(parameter.default_value);
  }
  setting.options.assign(options.size(), 0);
  return setting;
}

std::vector<std::string> Model::state_names() const { return names_of(states); }

std::string Model::name_in_kernel(const std::string& channel) const { return kernel_name(channel); }

Model Model::reduced(const Reduction& to) const {
  Model out = *this;
  out.whole = this;
  out.reduction = to;
  out.states.clear();
  out.angles.clear();
  out.range_groups.clear();
  out.diverged_above.clear();
  for (const std::size_t state : to.kept) {
    if (std::ranges::find(angles, state) != angles.end()) out.angles.push_back(out.states.size());
    out.states.push_back(states[state]);
    out.range_groups.push_back(range_groups[state]);
    out.diverged_above.push_back(diverged_above[state]);
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
