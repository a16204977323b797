#include "study/detail/offers.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace gearsweep {
namespace {

// A part of the model that an observable is made for; of one for the whole all are empty.
struct Part {
  std::string name, unit, meaning;
};

std::vector<Part> parts_for(const Observable& observable, const Model& model) {
  std::vector<Part> parts;
  const auto add = [&](const ChannelInfo& channel) {
    if (channel.is_hidden) return;
    parts.push_back({channel.name, channel.unit, channel.meaning});
  };
  switch (observable.part) {
    case ObservedPart::whole:
      if (observable.is_of_surfaces && model.surfaces.empty()) return {};
      return {{}};
    case ObservedPart::surface:
      for (const SurfaceInfo& surface : model.surfaces) {
        if (surface.resets) parts.push_back({surface.name, "1", surface.name});
      }
      return parts;
    case ObservedPart::channel:
      std::ranges::for_each(model.states, add);
      std::ranges::for_each(model.signals, add);
      return parts;
    case ObservedPart::contact:
      for (const ContactInfo& contact : model.contacts) {
        parts.push_back({contact.name, model.signals[contact.deflection].unit, contact.name});
      }
      return parts;
    case ObservedPart::section:
      for (const SectionInfo& section : model.sections) {
        parts.push_back({section.name, model.signals[section.level].unit, section.name});
      }
      return parts;
  }
  return parts;
}

// What the names of the observable's quantities begin with.
std::string stem_of(const Observable& observable, const Part& part) {
  const bool is_named_by_part = observable.part == ObservedPart::channel ||
                                observable.part == ObservedPart::section ||
                                observable.part == ObservedPart::surface;
  if (is_named_by_part) return part.name;
  return part.name.empty() ? observable.name : part.name + "_" + observable.name;
}

constexpr const char* kPerPeriod = "/period";

// The unit of an output that looks at something of this unit.
std::string unit_of(const ObservableOutput& output, const std::string& seen, bool is_clockless) {
  if (output.unit == kPerPeriod) return is_clockless ? "1/tau" : "1";
  if (output.unit == "/tau") return seen == "b_n" ? "b_n varpi" : seen + "/tau";
  return output.unit.empty() && output.flags.empty() ? seen : output.unit;
}

// The offers of one observable for a part of the model.
void add_offers(const Observable& observable, const Part& part, const Sizes& sizes,
                bool is_clockless, std::vector<Offer>* offers) {
  for (std::size_t i = 0; i < observable.outputs.size(); ++i) {
    const ObservableOutput& output = observable.outputs[i];
    const std::string stem = stem_of(observable, part);
    Quantity quantity;
    quantity.name = output.suffix.empty() ? stem : stem + "_" + output.suffix;
    quantity.unit = unit_of(output, part.unit, is_clockless);
    quantity.meaning =
        part.meaning.empty() ? output.meaning : fmt::format("{}: {}", part.meaning, output.meaning);
    if (output.unit == kPerPeriod) {
      quantity.is_per_time = is_clockless;
      quantity.meaning += is_clockless ? ", per unit of time" : ", per period";
    }
    quantity.flags = output.flags;
    quantity.dimension = observable.dimension;
    if (observable.part == ObservedPart::channel) quantity.channel = part.name;
    quantity.width = observable.width(sizes);
    offers->push_back({quantity, {&observable, part.name, i}});
  }
}

// The section by which a motion is judged: the one that a study chose, or the first; empty where
// the model has none.
std::string judging_section(const Model& model, const std::string& chosen) {
  if (!chosen.empty() || model.sections.empty()) return chosen;
  return model.sections.front().name;
}

// These quantities of a section have a plain name, too; in a model without forcing instead of those
// that count by a clock.
std::vector<Offer> plain_offers(const Model& model, const std::vector<Offer>& offers,
                                const std::string& section) {
  std::vector<Offer> plain;
  for (const Offer& offer : offers) {
    if (section.empty() || offer.source.part != section) continue;
    if (offer.source.observable->part != ObservedPart::section) continue;
    Offer other = offer;
    other.quantity.name = offer.quantity.name.substr(section.size() + 1);
    const bool judges = other.quantity.name == "period" || other.quantity.name == "motion_class";
    const bool is_time =
        other.quantity.name == "cycle_time" || other.quantity.name == "settling_time";
    if (is_time || (judges && model.is_autonomous)) {
      plain.push_back(other);
    }
  }
  return plain;
}

}  // namespace

bool is_sampled_at_section(const Offer& offer) {
  const Observable& observable = *offer.source.observable;
  return observable.role == ObservableRole::samples && observable.part == ObservedPart::section;
}

bool needs_clock(const Offer& offer) {
  const OutputRole role = offer.role();
  return role == OutputRole::settled || role == OutputRole::exponent_per_period ||
         role == OutputRole::section_min || role == OutputRole::section_max ||
         offer.quantity.dimension == kOrders;
}

std::vector<Offer> offers_of(const Model& model, const Sizes& sizes, const std::string& section) {
  std::vector<Offer> offers;
  for (const Observable& observable : observables()) {
    for (const Part& part : parts_for(observable, model)) {
      add_offers(observable, part, sizes, model.is_clockless, &offers);
    }
  }
  const std::vector<Offer> plain = plain_offers(model, offers, judging_section(model, section));
  for (Offer& offer : offers) {
    const bool is_taken = std::ranges::any_of(
        plain, [&](const Offer& other) { return other.quantity.name == offer.quantity.name; });
    const bool judges_returns = offer.source.observable->part == ObservedPart::section &&
                                offer.role() == OutputRole::motion;
    const bool lacks_clock = model.is_clockless && needs_clock(offer);
    offer.is_named = !is_taken && !judges_returns && !is_sampled_at_section(offer) && !lacks_clock;
  }
  offers.insert(offers.begin(), plain.begin(), plain.end());
  return offers;
}

}  // namespace gearsweep
