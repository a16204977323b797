#include "plan/passive_states.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <iterator>
#include <optional>
#include <set>

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

// The signals that it looks at, those of contacts among them.
std::set<std::size_t> signals_looked_at(const Study& study) {
  std::set<std::size_t> signals;
  for (const Observer& observer : study.selection.observers) {
    if (observer.observable->part == ObservedPart::channel) {
      const int signal = study.model->find_signal(observer.part);
      if (signal >= 0) signals.insert(static_cast<std::size_t>(signal));
    }
    for (const SectionInfo& section : study.model->sections) {
      const bool is_seen =
          observer.observable->part == ObservedPart::section && section.name == observer.part;
      if (is_seen) signals.insert({section.level, section.rate, section.size});
    }
    if (observer.observable->part != ObservedPart::contact) continue;
    for (const ContactInfo& contact : study.model->contacts) {
      if (contact.name == observer.part) signals.insert({contact.deflection, contact.backlash});
    }
  }
  return signals;
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

// Whether all points start with x[second] = -x[first] in each pair, and keep it.
bool holds_mirrored(const Study& study, const MirrorPairs& pairs) {
  const std::vector<double>& values = study.setting.parameters;
  const bool are_alike = std::ranges::all_of(pairs.parameters, [&](const MirrorPairs::Pair& pair) {
    return values[pair.first] == values[pair.second] && !study.differs(pair.first) &&
           !study.differs(pair.second);
  });
  if (!are_alike) return false;
  for (const MirrorPairs::Pair& pair : pairs.states) {
    if (study.find_swept(true, pair.first) != nullptr ||
        study.find_swept(true, pair.second) != nullptr) {
      return false;
    }
    const Initial& initial = study.initial;
    const bool is_spread = initial.spread[pair.first] != 0.0 || initial.spread[pair.second] != 0.0;
    if (initial.ensemble > 1 && is_spread) return false;
  }
  if (study.initial.policy != InitialPolicy::fixed) return true;  // MirrorPairs: the equilibrium is
  const std::vector<double>& x = study.initial.state;
  return std::ranges::all_of(pairs.states, [&](const MirrorPairs::Pair& pair) {
    return x[pair.second] == -x[pair.first];
  });
}

Reduction reduction_of(const Study& study, Structure* structure) {
  const std::set<std::size_t> seen = states_looked_at(study);
  std::set<std::size_t> needed = seen;
  for (const std::size_t signal : signals_looked_at(study)) {
    needed.merge(structure->drivers_of_signal(signal));
  }
  const std::set<std::size_t> driving = structure->closure(needed);
  std::set<std::size_t> mirrored;
  Reduction reduction;
  for (const MirrorPairs& pairs : study.model->mirror_pairs) {
    const bool would_do = std::ranges::all_of(pairs.states, [&](const MirrorPairs::Pair& pair) {
      return driving.contains(pair.first) && driving.contains(pair.second) &&
             !seen.contains(pair.second);
    });
    if (!would_do || !holds_mirrored(study, pairs)) continue;
    if (!structure->keeps_mirrored(pairs.states)) continue;
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

// The settings that the points have of some parameters. Nothing where these are too many to look
// at, or where a parameter is both on an axis and uncertain.
std::optional<std::vector<ModelSetting>> settings_of(const Study& study,
                                                     const std::vector<std::size_t>& parameters) {
  constexpr std::size_t kMany = 10000;
  const auto is_one = [&](const Swept& swept) {
    return !swept.is_state && std::ranges::find(parameters, swept.index) != parameters.end();
  };
  for (const UncertainParameter& parameter : study.uncertain.parameters) {
    for (const Swept& swept : parameter.draws.swept()) {
      if (is_one(swept) && study.find_on_axes(swept.index) != nullptr) return std::nullopt;
    }
  }
  std::vector<ModelSetting> settings = {study.setting};
  for (const Axis& axis : axes_and_draws(study)) {
    if (std::ranges::none_of(axis.swept(), is_one)) continue;
    if (settings.size() * axis.values.size() > kMany) return std::nullopt;
    std::vector<ModelSetting> wider;
    for (std::size_t place = 0; place < axis.values.size(); ++place) {
      for (ModelSetting setting : settings) {
        for (const Swept& swept : axis.swept()) {
          if (!swept.is_state) setting.parameters[swept.index] = swept.values[place];
        }
        wider.push_back(std::move(setting));
      }
    }
    settings = std::move(wider);
  }
  return settings;
}

// What is left out must decay at all points.
bool decays_everywhere(const Study& study, const Model& reduced,
                       const std::vector<std::size_t>& parameters) {
  const auto settings = settings_of(study, parameters);
  return settings && std::ranges::all_of(*settings, [&](const ModelSetting& setting) {
           const std::vector<double> exponents = left_out_exponents(reduced, setting);
           return !exponents.empty() && exponents.front() < 0.0;
         });
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
    observer.accumulators =
        numbers_of(observer.observable->accumulators,
                   {reduced.states.size(), reduced.perturbed_states(), selection->orders.size()});
  }
}

}  // namespace

Study without_passive_states(const Study& study) {
  const Selection& selection = study.selection;
  if (study.integrate.states == States::all || study.model->whole != nullptr ||
      study.integrate.engine != EngineKind::opencl ||
      // A reset may put any state anywhere.
      std::ranges::any_of(study.model->surfaces, &SurfaceInfo::resets) ||
      std::ranges::any_of(selection.observers, looks_at_all_states)) {
    return study;
  }
  Structure structure(study);
  Reduction reduction = reduction_of(study, &structure);
  if (reduction.kept.size() == study.model->states.size()) return study;
  if (!structure.is_finite_whatever(reduction.passive, signals_looked_at(study))) return study;
  const std::optional<LinearBlock> block = structure.left_out(reduction);
  if (!block) return study;
  reduction.block = [values = block->values](const ModelSetting& setting) {
    return values.run_all(setting.parameters);
  };
  const auto kept = std::make_shared<const KeptModels>(
      KeptModels{study.own_model, study.model->reduced(reduction)});
  if (!decays_everywhere(study, kept->reduced, block->parameters)) return study;
  Study out = study;
  out.own_model = {kept, &kept->reduced};
  out.model = &kept->reduced;
  fit(kept->reduced, &out.selection);
  return out;
}

std::vector<double> left_out_exponents(const Model& reduced, const ModelSetting& setting) {
  const std::vector<double> block = reduced.reduction.block(setting);
  const auto size = static_cast<std::size_t>(std::lround(std::sqrt(block.size())));
  std::vector<double> exponents;
  for (const std::complex<double>& value : eigenvalues(block.data(), size)) {
    exponents.push_back(value.real());
  }
  std::ranges::sort(exponents, std::greater());
  return exponents;
}

}  // namespace gearsweep
