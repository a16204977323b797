#include "study/selection.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "model/error.hpp"
#include "model/names.hpp"

namespace gearsweep {
namespace {

// Where a quantity comes from.
struct Source {
  const Observable* observable;
  std::string channel;
  std::size_t output_in_observable;
};

struct Offer {
  Quantity quantity;
  Source source;
};

bool model_has_signals(const Model& model, const Observable& observable) {
  return std::all_of(observable.needed_signals.begin(), observable.needed_signals.end(),
                     [&](const std::string& signal) { return model.find_signal(signal) >= 0; });
}

// The offers of one observable: once for each channel, or once.
void add_offers(const Observable& observable, const ChannelInfo& channel, std::size_t state_count,
                std::vector<Offer>* offers) {
  for (std::size_t i = 0; i < observable.outputs.size(); ++i) {
    const ObservableOutput& output = observable.outputs[i];
    const bool per_channel = observable.kind == ObservableKind::channel;
    const std::string& stem = per_channel ? channel.name : observable.name;
    Quantity quantity;
    quantity.name = output.suffix.empty() ? stem : stem + "_" + output.suffix;
    quantity.unit = output.unit.empty() && output.flags.empty() ? channel.unit : output.unit;
    quantity.meaning =
        per_channel ? fmt::format("{}: {}", channel.meaning, output.meaning) : output.meaning;
    quantity.flags = output.flags;
    quantity.dimension = observable.dimension;
    if (per_channel) quantity.channel = channel.name;
    if (!observable.dimension.empty()) quantity.width = state_count;
    offers->push_back({quantity, {&observable, per_channel ? channel.name : "", i}});
  }
}

std::vector<Offer> offers_of(const Model& model) {
  std::vector<Offer> offers;
  for (const Observable& observable : observables()) {
    if (!model_has_signals(model, observable)) continue;
    if (observable.kind != ObservableKind::channel) {
      add_offers(observable, {}, model.states.size(), &offers);
      continue;
    }
    for (const ChannelInfo& state : model.states) {
      add_offers(observable, state, model.states.size(), &offers);
    }
    for (const ChannelInfo& signal : model.signals) {
      add_offers(observable, signal, model.states.size(), &offers);
    }
  }
  return offers;
}

// Quantities that no observer gives, since they need the whole map.
std::vector<Quantity> surveyed_quantities() {
  Quantity attractor;
  attractor.name = "attractor";
  attractor.meaning = "number of the attractor reached, by the file's list; 0: undecided";
  attractor.is_surveyed = true;
  Quantity count = attractor;
  count.name = "attractor_count";
  count.meaning = "attractors that the initial states of the ensemble reached; needs an ensemble";
  return {attractor, count};
}

std::size_t resolve_count(int count, std::size_t states) {
  return static_cast<std::size_t>(count % kPerState) +
         static_cast<std::size_t>(count / kPerState) * states;
}

// Index of the first output of an observer, which is added when the selection has it not yet.
std::size_t first_output_of(const Source& source, std::size_t states, Selection* selection) {
  std::size_t first = 0;
  for (const Observer& observer : selection->observers) {
    if (observer.observable == source.observable && observer.channel == source.channel) {
      return first;
    }
    first += observer.outputs;
  }
  const Observable& observable = *source.observable;
  selection->observers.push_back(
      {&observable, source.channel, resolve_count(observable.accumulators, states),
       observable.outputs.size() * (observable.dimension.empty() ? 1 : states),
       resolve_count(observable.tangents, states)});
  return first;
}

// The output of a quantity that the model offers, with the observer that gives it.
std::size_t add_output(const std::vector<Offer>& offers, const std::string& name,
                       std::size_t states, Selection* selection) {
  const auto offer = std::find_if(offers.begin(), offers.end(), [&](const Offer& candidate) {
    return candidate.quantity.name == name;
  });
  return first_output_of(offer->source, states, selection) +
         offer->source.output_in_observable * offer->quantity.width;
}

void add_survey(const Model& model, const std::vector<Offer>& offers, Selection* selection) {
  const auto output = [&](const std::string& name) {
    return add_output(offers, name, model.states.size(), selection);
  };
  Survey survey;
  survey.motion = output("motion_class");
  survey.period = output("period");
  survey.section_min = output("section_min");
  survey.section_max = output("section_max");
  survey.rms = output(model.states.front().name + "_rms");
  survey.exponent = output("lyapunov_max");
  if (model.find_signal("dmf") >= 0) survey.peak = output("dmf_max");
  selection->survey = survey;
  selection->motion = survey.motion;
}

std::vector<std::size_t> find_states(const Model& model, const std::vector<std::string>& names) {
  std::vector<std::size_t> found;
  for (const std::string& name : names) {
    const int index = model.find_state(name);
    if (index < 0) {
      std::vector<std::string> known;
      for (const ChannelInfo& state : model.states) known.push_back(state.name);
      throw InputError(fmt::format("unknown state '{}' of model '{}'{}", name, model.name,
                                   suggest_name(name, known)));
    }
    const auto state = static_cast<std::size_t>(index);
    if (std::find(found.begin(), found.end(), state) != found.end()) {
      throw InputError(fmt::format("state '{}' is listed twice", name));
    }
    found.push_back(state);
  }
  return found;
}

}  // namespace

std::size_t Selection::output_count() const {
  std::size_t count = 0;
  for (const Observer& observer : observers) count += observer.outputs;
  return count;
}

std::size_t Selection::accumulator_count() const {
  std::size_t count = 0;
  for (const Observer& observer : observers) count += observer.accumulators;
  return count;
}

std::size_t Selection::tangent_count() const {
  std::size_t count = 0;
  for (const Observer& observer : observers) count = std::max(count, observer.tangents);
  return count;
}

std::vector<Quantity> offered_quantities(const Model& model) {
  std::vector<Quantity> out;
  for (const Offer& offer : offers_of(model)) out.push_back(offer.quantity);
  for (const Quantity& quantity : surveyed_quantities()) out.push_back(quantity);
  Quantity status;
  status.name = "status";
  status.meaning = "why the point ended; always there";
  out.push_back(status);
  return out;
}

std::vector<std::string> motion_names() {
  for (const Observable& observable : observables()) {
    if (observable.name == "motion") return observable.outputs.front().flags;
  }
  return {};
}

Selection select_quantities(const Model& model, const std::vector<std::string>& names,
                            const std::vector<std::string>& poincare_states) {
  const std::vector<Offer> offers = offers_of(model);
  const std::vector<std::size_t> sampled = find_states(model, poincare_states);
  const std::vector<Quantity> known = offered_quantities(model);
  Selection selection;
  std::set<std::string> listed;
  for (const std::string& name : names) {
    const auto found = std::find_if(known.begin(), known.end(), [&](const Quantity& candidate) {
      return candidate.name == name;
    });
    if (found == known.end()) {
      std::vector<std::string> known_names;
      for (const Quantity& candidate : known) known_names.push_back(candidate.name);
      throw InputError(fmt::format("unknown quantity '{}' of model '{}'{}", name, model.name,
                                   suggest_name(name, known_names)));
    }
    if (name == "status") continue;  // always there
    if (!listed.insert(name).second) {
      throw InputError(fmt::format("quantity '{}' is listed twice", name));
    }
    if (name == "poincare") {
      if (sampled.empty()) throw InputError("observe.poincare names no state");
      selection.poincare = sampled;
      continue;
    }
    Quantity quantity = *found;
    if (quantity.is_surveyed) {
      add_survey(model, offers, &selection);
    } else {
      quantity.output = add_output(offers, name, model.states.size(), &selection);
    }
    if (name == "motion_class") selection.motion = quantity.output;
    if (name == "lyapunov_max_error") {
      const std::size_t states = model.states.size();
      selection.exponent_error = {add_output(offers, "lyapunov_max", states, &selection),
                                  quantity.output,
                                  add_output(offers, "period", states, &selection)};
    }
    selection.quantities.push_back(quantity);
  }
  return selection;
}

}  // namespace gearsweep
