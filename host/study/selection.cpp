#include "study/selection.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "model/error.hpp"
#include "model/names.hpp"
#include "study/detail/load_factor.hpp"
#include "study/detail/offers.hpp"

namespace gearsweep {
namespace {

// Quantities that no observer gives, since they need the whole map.
std::vector<Quantity> census_quantities() {
  Quantity attractor;
  attractor.name = "attractor";
  attractor.meaning = "number of the attractor reached, by the file's list; 0: undecided";
  attractor.of_census = true;
  Quantity count = attractor;
  count.name = "attractor_count";
  count.meaning = "attractors that the initial states of the ensemble reached; needs an ensemble";
  return {attractor, count};
}

// Index of the first output of an observer, which is added when the selection has it not yet.
std::size_t first_output_of(const Source& source, const Sizes& sizes, Selection* selection) {
  std::size_t first = 0;
  for (const Observer& observer : selection->observers) {
    if (observer.observable == source.observable && observer.part == source.part) {
      return first;
    }
    first += observer.outputs;
  }
  const Observable& observable = *source.observable;
  const std::size_t outputs =
      observable.role == ObservableRole::samples ? 0 : observable.outputs.size();
  selection->observers.push_back(
      {&observable, source.part, numbers_of(observable.accumulators, sizes),
       outputs * observable.width(sizes), observable.tangents_of(sizes)});
  return first;
}

std::size_t add_output(const Offer& offer, const Sizes& sizes, Selection* selection) {
  return first_output_of(offer.source, sizes, selection) +
         offer.source.output_in_observable * offer.quantity.width;
}

// The output of this role, with the observer that gives it.
std::size_t add_role(const std::vector<Offer>& offers, OutputRole role, const std::string& channel,
                     const Sizes& sizes, Selection* selection) {
  const auto offer = std::find_if(offers.begin(), offers.end(), [&](const Offer& candidate) {
    return candidate.role() == role && candidate.source.part == channel;
  });
  return add_output(*offer, sizes, selection);
}

void add_census(const Model& model, const std::vector<Offer>& offers, const Sizes& sizes,
                Selection* selection) {
  const auto output = [&](OutputRole role, const std::string& channel = "") {
    return add_role(offers, role, channel, sizes, selection);
  };
  // Without forcing these are by returns, as a study's own quantities are.
  const auto named = [&](const std::string& name) {
    const auto offer = std::ranges::find_if(
        offers, [&](const Offer& candidate) { return candidate.quantity.name == name; });
    return add_output(*offer, sizes, selection);
  };
  CensusOutputs census;
  census.motion = named("motion_class");
  census.period = named("period");
  census.section_min = output(OutputRole::section_min);
  census.section_max = output(OutputRole::section_max);
  census.mean = output(OutputRole::state_mean);
  census.std = output(OutputRole::state_std);
  census.mean_error = output(OutputRole::state_mean_error);
  census.std_error = output(OutputRole::state_std_error);
  census.rms = output(OutputRole::rms, model.states.front().name);
  census.exponent = output(OutputRole::exponent);
  if (const ChannelInfo* force = model.contact_force()) {
    census.peak = output(OutputRole::peak, force->name);
  }
  selection->census = census;
  selection->motion = census.motion;
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

void refuse_unknown_section(const Model& model, const std::string& name) {
  std::vector<std::string> known;
  for (const SectionInfo& section : model.sections) known.push_back(section.name);
  if (std::ranges::find(known, name) != known.end()) return;
  throw InputError(known.empty() ? fmt::format("model '{}' has no sections: give one, as in\n"
                                               "  [sections.{}]\n  maximum_of = \"{}\"",
                                               model.name, name, model.states.front().name)
                                 : fmt::format("unknown section '{}' of model '{}'{}", name,
                                               model.name, suggest_name(name, known)));
}

// One order of a channel: "dte_order_2_amplitude", "dte_order_0_5_phase".
struct OneOrder {
  std::string quantity;  // of all orders: "dte_order_amplitude"
  std::size_t place;     // among the study's orders
};

// The text of an order in the name of a quantity: "0_5" of 0.5.
std::string order_word(double order) {
  std::string word = fmt::format("{}", order);
  std::ranges::replace(word, '.', '_');
  return word;
}

std::optional<OneOrder> find_order(const std::string& name, const std::vector<double>& orders) {
  for (const char* what : {"amplitude", "phase"}) {
    for (std::size_t i = 0; i < orders.size(); ++i) {
      const std::string ending = fmt::format("_order_{}_{}", order_word(orders[i]), what);
      if (!name.ends_with(ending)) continue;
      return OneOrder{fmt::format("{}_order_{}", name.substr(0, name.size() - ending.size()), what),
                      i};
    }
  }
  return std::nullopt;
}

[[noreturn]] void refuse_unknown_quantity(const Model& model, const std::string& name,
                                          const std::vector<Offer>& offers,
                                          const std::vector<Quantity>& known) {
  const std::string lack = name.ends_with(kLoadFactor) ? lack_of_load(model) : "";
  if (!lack.empty()) throw InputError(lack);
  for (const Offer& offer : offers) {
    if (offer.quantity.name != name || !model.is_clockless || !needs_clock(offer)) continue;
    throw InputError(fmt::format(
        "'{}' goes by the periods of a forcing, and model '{}' has none{}", name, model.name,
        offer.role() == OutputRole::settled
            ? ": settling_time is the time until its motion stayed periodic"
            : ""));
  }
  std::vector<std::string> known_names;
  for (const Quantity& candidate : known) known_names.push_back(candidate.name);
  throw InputError(fmt::format("unknown quantity '{}' of model '{}'{}", name, model.name,
                               suggest_name(name, known_names)));
}

// The quantity of a name, of which `asked` speaks; refuses a name that is unknown or stands for
// two.
const Quantity& find_quantity(const Model& model, const std::string& name, const std::string& asked,
                              const std::vector<Offer>& offers,
                              const std::vector<Quantity>& known) {
  const auto is_named = [&](const Quantity& candidate) { return candidate.name == name; };
  const auto found = std::find_if(known.begin(), known.end(), is_named);
  if (found == known.end()) refuse_unknown_quantity(model, asked, offers, known);
  const auto same = std::find_if(found + 1, known.end(), is_named);
  if (same == known.end()) return *found;
  throw InputError(fmt::format(
      "'{}' stands for two quantities of model '{}' (\"{}\" and \"{}\"): rename the state or "
      "signal of one",
      name, model.name, found->meaning, same->meaning));
}

// Adds quantities to a selection, with the observers that give them.
class Selector {
 public:
  Selector(const Model& model, const Sizes& sizes, const std::vector<Offer>& offers,
           Selection* selection)
      : model_(model), sizes_(sizes), offers_(offers), selection_(*selection) {}

  void add_of_census(const Quantity& quantity) {
    add_census(model_, offers_, sizes_, &selection_);
    selection_.quantities.push_back(quantity);
  }

  void add_load_factor(Quantity quantity) {
    const std::vector<LoadFactor> factors = load_factors(model_);
    const auto factor = std::ranges::find_if(factors, [&](const LoadFactor& candidate) {
      return candidate.quantity.name == quantity.name;
    });
    quantity.output = add_role(offers_, OutputRole::peak, factor->force, sizes_, &selection_);
    selection_.quantities.push_back(std::move(quantity));
  }

  // One of the numbers of a quantity that has one for each order.
  void add_one_order(Quantity quantity, const OneOrder& order, const std::string& asked,
                     const std::vector<double>& orders) {
    const Offer& offer = offer_of(quantity.name);
    quantity.output = add_output(offer, sizes_, &selection_) + order.place;
    quantity.role = offer.role();
    quantity.name = asked;
    quantity.meaning = fmt::format("order {}: {}", orders[order.place], quantity.meaning);
    quantity.width = 1;
    quantity.dimension.clear();
    selection_.orders = orders;
    selection_.quantities.push_back(std::move(quantity));
  }

  // sampled: the states that `poincare` keeps.
  void add_observed(Quantity quantity, const std::vector<std::size_t>& sampled,
                    const std::vector<double>& orders) {
    const Offer& offer = offer_of(quantity.name);
    const bool is_samples = offer.source.observable->role == ObservableRole::samples;
    if (is_samples && sampled.empty()) {
      throw InputError(fmt::format("observe.{} names no state", quantity.name));
    }
    quantity.output = add_output(offer, sizes_, &selection_);
    quantity.width = offer.quantity.width;
    if (quantity.dimension == kOrders) selection_.orders = orders;
    if (is_samples) {
      selection_.poincare = sampled;
      return;
    }
    quantity.role = offer.role();
    if (offer.role() == OutputRole::motion) selection_.motion = quantity.output;
    // With a clock a motion has no return map, which knows how long its steps are.
    if (offer.role() == OutputRole::exponent_error && model_.clocks == 0) {
      selection_.exponent_error = {add_role(offers_, OutputRole::exponent, "", sizes_, &selection_),
                                   quantity.output,
                                   add_role(offers_, OutputRole::period, "", sizes_, &selection_)};
    }
    selection_.quantities.push_back(std::move(quantity));
  }

 private:
  const Offer& offer_of(const std::string& name) const {
    const std::string& section = selection_.section;
    const bool is_elsewhere = name == "poincare" && !section.empty();
    return *std::ranges::find_if(offers_, [&](const Offer& candidate) {
      if (is_elsewhere) {
        return is_sampled_at_section(candidate) && candidate.source.part == section;
      }
      return candidate.is_named && candidate.quantity.name == name;
    });
  }

  const Model& model_;
  const Sizes& sizes_;
  const std::vector<Offer>& offers_;
  Selection& selection_;
};

}  // namespace

std::optional<std::size_t> Selection::output_of(OutputRole role) const {
  std::size_t first = 0;
  for (const Observer& observer : observers) {
    // An output of every state is told of once. Samples are no outputs.
    const std::vector<ObservableOutput>& told = observer.observable->outputs;
    const std::size_t width = told.empty() ? 0 : observer.outputs / told.size();
    for (std::size_t i = 0; width > 0 && i < told.size(); ++i) {
      if (told[i].role == role) return first + i * width;
    }
    first += observer.outputs;
  }
  return std::nullopt;
}

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

std::vector<std::string> Selection::watched_sections() const {
  std::vector<std::string> names;
  for (const Observer& observer : observers) {
    if (observer.observable->part != ObservedPart::section) continue;
    if (std::ranges::find(names, observer.part) == names.end()) names.push_back(observer.part);
  }
  return names;
}

std::vector<Quantity> offered_quantities(const Model& model) {
  const Sizes sizes = {model.states.size(), model.perturbed_states(), kDefaultOrders.size()};
  std::vector<Quantity> out;
  for (const Offer& offer : offers_of(model, sizes, "")) {
    if (offer.is_named) out.push_back(offer.quantity);
  }
  for (const LoadFactor& factor : load_factors(model)) out.push_back(factor.quantity);
  for (const Quantity& quantity : census_quantities()) out.push_back(quantity);
  Quantity status;
  status.name = "status";
  status.meaning = "why the point ended; always there";
  out.push_back(status);
  return out;
}

std::vector<std::string> motion_names() {
  std::vector<std::string> names;  // the longest list: others are its beginning
  for (const Observable& observable : observables()) {
    for (const ObservableOutput& output : observable.outputs) {
      const bool is_longer = output.flags.size() > names.size();
      if (output.role == OutputRole::motion && is_longer) names = output.flags;
    }
  }
  return names;
}

Selection select_quantities(const Model& model, const std::vector<std::string>& names,
                            const std::vector<std::string>& poincare_states,
                            const std::vector<double>& orders, const std::string& section) {
  const Sizes sizes = {model.states.size(), model.perturbed_states(), orders.size()};
  const std::vector<Offer> offers = offers_of(model, sizes, section);
  const std::vector<std::size_t> sampled = find_states(model, poincare_states);
  const std::vector<Quantity> known = offered_quantities(model);
  Selection selection;
  selection.section = section;
  if (!section.empty()) refuse_unknown_section(model, section);
  Selector selector(model, sizes, offers, &selection);
  std::set<std::string> listed;
  for (const std::string& asked : names) {
    const bool is_known = std::ranges::find(known, asked, &Quantity::name) != known.end();
    const std::optional<OneOrder> order = is_known ? std::nullopt : find_order(asked, orders);
    if (asked == "status") continue;  // always there
    if (!listed.insert(asked).second) {
      throw InputError(fmt::format("quantity '{}' is listed twice", asked));
    }
    const Quantity& quantity =
        find_quantity(model, order ? order->quantity : asked, asked, offers, known);
    if (order) {
      selector.add_one_order(quantity, *order, asked, orders);
    } else if (quantity.of_census) {
      selector.add_of_census(quantity);
    } else if (quantity.divided_by) {
      selector.add_load_factor(quantity);
    } else {
      selector.add_observed(quantity, sampled, orders);
    }
  }
  if (selection.census && model.contacts.size() == 1 && !model.is_clockless) {
    selection.census->impacts_drive = selection.output_of(OutputRole::impacts_drive);
    selection.census->impacts_back = selection.output_of(OutputRole::impacts_back);
  }
  return selection;
}

}  // namespace gearsweep
