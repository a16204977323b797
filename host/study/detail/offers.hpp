// The quantities that a model offers, each with the observable and the part of the model that it
// comes from.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "study/selection.hpp"

namespace gearsweep {

// Where a quantity comes from.
struct Source {
  const Observable* observable;
  std::string part;
  std::size_t output_in_observable;
};

struct Offer {
  Quantity quantity;
  Source source;
  bool is_named = true;  // false of one whose name another one has, or that has none of its own

  OutputRole role() const { return source.observable->outputs[source.output_in_observable].role; }
};

// Those of one state, signal, contact, surface or section come in the model's order; those with a
// plain name come first. section: by which a motion is judged; empty: the model's first.
std::vector<Offer> offers_of(const Model& model, const Sizes& sizes, const std::string& section);

// Whether it is taken at the returns to a section, instead of at phase 0.
bool is_sampled_at_section(const Offer& offer);
// Whether it counts by the period of a forcing, or looks at phase 0.
bool needs_clock(const Offer& offer);

}  // namespace gearsweep
