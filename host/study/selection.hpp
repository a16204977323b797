// Which observables run and which of their outputs become maps.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "model/model.hpp"
#include "model/observable.hpp"

namespace gearsweep {

// One observable at work; `channel` is a state or signal, empty unless there is one for each.
struct Observer {
  const Observable* observable = nullptr;
  std::string part;  // name of the state, signal or contact that it looks at
  // Numbers for each point, with the model's number of states put in.
  std::size_t accumulators = 0, outputs = 0, tangents = 0;
};

// One map.
struct Quantity {
  std::string name, unit, meaning;
  std::vector<std::string> flags;  // class names when the value is a class
  std::size_t output = 0;          // index among the outputs of all observers, in their order
  bool of_census = false;          // not an output, but found from the whole map (attractors/)
  bool of_draws = false;           // not an output, but of those of all draws (sweep/draw_maps.hpp)
  std::size_t width = 1;           // numbers for each point, next to each other among the outputs
  std::string dimension;           // the name of what they stand along; empty when width = 1
  std::string channel;             // the state or signal that it looks at; empty: none
  // The parameter by which the output is divided; where that is 0 there is no value.
  std::optional<std::size_t> divided_by;
  // The output counts how often in a period, of a model without forcing: Binding::clock divides it.
  bool is_per_time = false;
  OutputRole role = OutputRole::none;
};

// What the list of attractors is made of: outputs of observers that run for it. Of the attractor's
// own look there are the box around its section, the moments of its states and what is told of it
// in the list.
struct CensusOutputs {
  std::size_t motion = 0, period = 0;  // motion_class, period
  // The first of one output per state each.
  std::size_t section_min = 0, section_max = 0;
  std::size_t mean = 0, std = 0, mean_error = 0, std_error = 0;  // state_moments
  std::size_t rms = 0;                                           // of the model's first state
  std::size_t exponent = 0;                                      // lyapunov_max
  std::optional<std::size_t> peak;  // of Model::contact_force(), where there is one
  // Places of the impacts of the model's only contact, where the study asks for them anyway.
  std::optional<std::size_t> impacts_drive, impacts_back;
};

// What the error of the largest exponent needs: outputs of lyapunov_max and period.
struct ExponentError {
  std::size_t exponent = 0, error = 0, period = 0;
};

struct Selection {
  std::vector<Observer> observers;
  std::vector<Quantity> quantities;   // without status (always there) and poincare
  std::vector<std::size_t> poincare;  // states sampled at phase 0; empty: not asked for
  std::string section;                // at which they are, instead; empty: at phase 0
  // Orders whose amplitudes and phases are asked for, in multiples of the mesh frequency
  // (Model::mesh_periods); empty: none.
  std::vector<double> orders;
  // Output of motion_class, when an observer looks for kinds of motion.
  std::optional<std::size_t> motion;
  std::optional<CensusOutputs> census;          // when attractors are to be told apart
  std::optional<ExponentError> exponent_error;  // when lyapunov_max_error is asked for
  // Two states at phase 0 are the same when they differ by no more than this, relative to the
  // range of the motion (kernels/observables/period.h).
  double period_tolerance = 1e-6;

  // Index among the outputs of all observers; nothing where there is none of this role.
  std::optional<std::size_t> output_of(OutputRole role) const;
  std::size_t output_count() const;       // of all observers
  std::size_t accumulator_count() const;  // of all observers
  std::size_t tangent_count() const;      // tangent vectors that suffice for all observers
  // Names of the sections that observers look at, in the order of these; none twice.
  std::vector<std::string> watched_sections() const;
};

// Every quantity that a model offers, `poincare` and `status` included.
std::vector<Quantity> offered_quantities(const Model& model);

// The classes of motion_class, by value.
std::vector<std::string> motion_names();

// Those of a study that names none.
inline const std::vector<double> kDefaultOrders = {1.0, 2.0, 3.0};

// Resolves quantity names. section: where poincare samples are taken. Throws InputError with the
// nearest known name (the caller adds the place).
Selection select_quantities(const Model& model, const std::vector<std::string>& names,
                            const std::vector<std::string>& poincare_states,
                            const std::vector<double>& orders = kDefaultOrders,
                            const std::string& section = "");

}  // namespace gearsweep
