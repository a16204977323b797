#include "plan/passive_states.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <iterator>
#include <random>
#include <set>

#include "model/array.hpp"
#include "model/eigenvalues.hpp"
#include "plan/detail/structure.hpp"

namespace gearsweep {
namespace {

bool looks_at_all_states(const Observer& observer) {
  const Observable& observable = *observer.observable;
  return observable.has_each_state() || observable.tangents >= kPerState;
}

// The states that the study looks at itself. Observables of the section follow the first state.
std::set<std::size_t> states_looked_at(const Study& study) {
  std::set<std::size_t> seen(study.selection.poincare.begin(), study.selection.poincare.end());
  seen.insert(0);
  for (const Observer& observer : study.selection.observers) {
    const int state = study.model->find_state(observer.part);
    if (state >= 0) seen.insert(static_cast<std::size_t>(state));
  }
  return seen;
}

// The states that the signals it looks at depend on.
std::set<std::size_t> states_of_signals(const Study& study, const Structure& structure) {
  std::set<std::size_t> states;
  const auto see = [&](std::size_t signal) { states.merge(structure.drivers_of_signal(signal)); };
  for (const Observer& observer : study.selection.observers) {
    if (observer.observable->part == ObservedPart::channel) {
      const int signal = study.model->find_signal(observer.part);
      if (signal >= 0) see(static_cast<std::size_t>(signal));
    }
    if (observer.observable->part != ObservedPart::contact) continue;
    for (const ContactInfo& contact : study.model->contacts) {
      if (contact.name != observer.part) continue;
      see(contact.deflection);
      see(contact.backlash);
    }
  }
  return states;
}

// Places of an axis that stand for all: those of the least and of the largest value of each thing
// swept, and one between; or all of them.
std::set<std::size_t> chosen_places(const Axis& axis, bool all) {
  std::set<std::size_t> places;
  const std::size_t count = axis.values.size();
  for (std::size_t place = 0; place < count && (all || count <= 3); ++place) places.insert(place);
  if (!places.empty()) return places;
  for (const Swept& swept : axis.swept()) {
    const auto [min, max] = std::ranges::minmax_element(swept.values);
    places.insert(static_cast<std::size_t>(min - swept.values.begin()));
    places.insert(static_cast<std::size_t>(max - swept.values.begin()));
  }
  places.insert(count / 2);
  return places;
}

// What an axis of several columns may make of a setting, though no point need have it: each column
// is somewhere else between its ends, so that what two of them make together does not vanish.
void mix_columns(const Axis& axis, ModelSetting* setting) {
  constexpr double kGoldenRatio = 0.6180339887498949;  // its multiples repeat no share
  double share = 0.0;
  for (const Swept& swept : axis.columns) {
    share = std::fmod(share + kGoldenRatio, 1.0);
    const auto [min, max] = std::ranges::minmax(swept.values);
    if (!swept.is_state) setting->parameters[swept.index] = min + share * (max - min);
  }
}

// The axes, and the draws of uncertain parameters as one more.
std::vector<Axis> axes_and_draws(const Study& study) {
  std::vector<Axis> axes = study.axes;
  Axis draws;
  draws.is_list = true;
  for (const UncertainParameter& parameter : study.uncertain.parameters) {
    for (Swept column : parameter.draws.swept()) {
      if (study.find_on_axes(column.index) != nullptr) continue;  // its axis goes through values
      for (double& value : column.values) {
        if (parameter.is_factor) value *= study.setting.parameters[column.index];
      }
      draws.columns.push_back(std::move(column));
    }
    draws.values = parameter.draws.values;
  }
  if (!draws.columns.empty()) axes.push_back(std::move(draws));
  return axes;
}

// Settings of the study: each axis goes through its chosen places, or all of them while the other
// one goes through the chosen.
std::vector<ModelSetting> settings_of(const Study& study, bool all) {
  std::vector<ModelSetting> settings;
  const std::vector<Axis> axes = axes_and_draws(study);
  const auto add = [&](std::size_t whole_axis) {
    std::vector<ModelSetting> own = {study.setting};
    for (std::size_t number = 0; number < axes.size(); ++number) {
      const Axis& axis = axes[number];
      if (!axis.sweeps_parameter()) continue;
      std::vector<ModelSetting> wider;
      for (const std::size_t place : chosen_places(axis, all && number == whole_axis)) {
        for (ModelSetting setting : own) {
          for (const Swept& swept : axis.swept()) {
            if (!swept.is_state) setting.parameters[swept.index] = swept.values[place];
          }
          wider.push_back(std::move(setting));
        }
      }
      for (ModelSetting setting : own) {
        if (all || axis.columns.size() < 2) break;
        mix_columns(axis, &setting);
        wider.push_back(std::move(setting));
      }
      own = std::move(wider);
    }
    std::ranges::move(own, std::back_inserter(settings));
  };
  for (std::size_t axis = 0; axis < (all ? axes.size() : 1); ++axis) add(axis);
  return settings;
}

// Whether all points start with x[second] = -x[first] in each pair, and keep it.
bool holds_mirrored(const Study& study, const MirrorPairs& pairs,
                    const std::vector<ModelSetting>& settings) {
  const std::vector<double>& values = study.setting.parameters;
  const bool are_alike = std::ranges::all_of(pairs.parameters, [&](const MirrorPairs::Pair& pair) {
    return values[pair.first] == values[pair.second] &&
           study.find_swept(false, pair.first) == nullptr &&
           study.find_swept(false, pair.second) == nullptr;
  });
  if (!are_alike) return false;
  const auto starts_mirrored = [&](const std::vector<double>& x) {
    return std::ranges::all_of(pairs.states, [&](const MirrorPairs::Pair& pair) {
      return x[pair.second] == -x[pair.first];
    });
  };
  for (const MirrorPairs::Pair& pair : pairs.states) {
    if (study.find_swept(true, pair.first) != nullptr ||
        study.find_swept(true, pair.second) != nullptr) {
      return false;
    }
    const Initial& initial = study.initial;
    const bool is_spread = initial.spread[pair.first] != 0.0 || initial.spread[pair.second] != 0.0;
    if (initial.ensemble > 1 && is_spread) return false;
  }
  if (study.initial.policy == InitialPolicy::fixed) return starts_mirrored(study.initial.state);
  return std::ranges::all_of(settings, [&](const ModelSetting& setting) {
    return starts_mirrored(study.model->equilibrium(setting));
  });
}

Reduction reduction_of(const Study& study, const Structure& structure,
                       const std::vector<ModelSetting>& settings) {
  const std::set<std::size_t> seen = states_looked_at(study);
  std::set<std::size_t> needed = states_of_signals(study, structure);
  needed.insert(seen.begin(), seen.end());
  const std::set<std::size_t> driving = structure.closure(needed);
  std::set<std::size_t> mirrored;
  Reduction reduction;
  for (const MirrorPairs& pairs : study.model->mirror_pairs) {
    const bool would_do = std::ranges::all_of(pairs.states, [&](const MirrorPairs::Pair& pair) {
      return driving.contains(pair.first) && driving.contains(pair.second) &&
             !seen.contains(pair.second);
    });
    if (!would_do || !holds_mirrored(study, pairs, settings)) continue;
    for (const MirrorPairs::Pair& pair : pairs.states) {
      reduction.mirrors.push_back(pair);
      mirrored.insert(pair.second);
    }
  }
  for (std::size_t state = 0; state < study.model->states.size(); ++state) {
    if (!driving.contains(state)) {
      reduction.passive.push_back(state);
    } else if (!mirrored.contains(state)) {
      reduction.kept.push_back(state);
    }
  }
  return reduction;
}

// What is left out must decay at all points. Mostly no axis changes how.
bool decays_everywhere(const Study& study, const Model& reduced,
                       const std::vector<ModelSetting>& settings) {
  const auto decays = [&](const ModelSetting& setting) {
    const std::vector<double> exponents = left_out_exponents(reduced, setting);
    return !exponents.empty() && exponents.front() < 0.0;
  };
  const std::vector<double> first = left_out_block(reduced, settings.front());
  const bool is_the_same = std::ranges::all_of(settings, [&](const ModelSetting& setting) {
    return left_out_block(reduced, setting) == first;
  });
  if (is_the_same) return decays(settings.front());
  return std::ranges::all_of(settings_of(study, true), decays);
}

// A reduced model, and the whole one where that is the study's own.
struct KeptModels {
  std::shared_ptr<const Model> whole;
  Model reduced;
};

// The observers' numbers for each point, and the places of sampled states.
void fit(const Model& reduced, Selection* selection) {
  for (std::size_t& state : selection->poincare) {
    state = static_cast<std::size_t>(std::ranges::find(reduced.reduction.kept, state) -
                                     reduced.reduction.kept.begin());
  }
  for (Observer& observer : selection->observers) {
    observer.accumulators = numbers_of(observer.observable->accumulators,
                                       {reduced.states.size(), selection->orders.size()});
  }
}

}  // namespace

Study without_passive_states(const Study& study) {
  const Selection& selection = study.selection;
  if (study.integrate.states == States::all || study.model->whole != nullptr ||
      study.integrate.engine != EngineKind::opencl ||
      std::ranges::any_of(selection.observers, looks_at_all_states)) {
    return study;
  }
  const std::vector<ModelSetting> settings = settings_of(study, false);
  const Structure structure(*study.model, settings);
  const Reduction reduction = reduction_of(study, structure, settings);
  if (reduction.kept.size() == study.model->states.size()) return study;
  if (!structure.leaves_constant_block(reduction)) return study;
  const auto kept = std::make_shared<const KeptModels>(
      KeptModels{study.own_model, study.model->reduced(reduction)});
  if (!decays_everywhere(study, kept->reduced, settings)) return study;
  Study out = study;
  out.own_model = {kept, &kept->reduced};
  out.model = &kept->reduced;
  fit(kept->reduced, &out.selection);
  return out;
}

std::vector<double> left_out_exponents(const Model& reduced, const ModelSetting& setting) {
  const std::vector<double> block = left_out_block(reduced, setting);
  const auto size = static_cast<std::size_t>(std::lround(std::sqrt(block.size())));
  std::vector<double> exponents;
  for (const std::complex<double>& value : eigenvalues(block.data(), size)) {
    exponents.push_back(value.real());
  }
  std::ranges::sort(exponents, std::greater());
  return exponents;
}

}  // namespace gearsweep
