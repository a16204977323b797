#include "study/detail/initial_reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "model/error.hpp"
#include "study/detail/toml_access.hpp"

namespace gearsweep {
namespace {

std::vector<std::string> axis_names(const Study& study) {
  std::vector<std::string> names;
  for (const Axis& axis : study.axes) names.push_back(axis.name);
  return names;
}

// 'policy = "forward" or "backward"', for a message.
std::string choice_of(const std::vector<std::string>& policies) {
  return fmt::format("policy = \"{}\"", fmt::join(policies, "\" or \""));
}

// The states of all models are of the order of 1, and so is the default spread.
void read_ensemble(TableReader* reader, Study* study) {
  const Model& model = *study->model;
  Initial& initial = study->initial;
  initial.ensemble = reader->count("ensemble", initial.ensemble);
  initial.seed = reader->count("seed", initial.seed);
  initial.spread.assign(model.states.size(), 1.0);
  const toml::node* spread = reader->find("spread");
  for (const char* key : {"seed", "spread"}) {
    if (initial.ensemble == 1 && reader->find(key) != nullptr) {
      fail_at(*reader->find(key), fmt::format("{} belongs to an ensemble: give ensemble = 8, for "
                                              "example",
                                              key));
    }
  }
  if (initial.ensemble > 1 && study->is_chained()) {
    fail_at(*reader->find("ensemble"),
            fmt::format("an ensemble cannot go on from its neighbour: it needs {}",
                        choice_of(policy_names(false))));
  }
  if (spread == nullptr) return;
  initial.spread = read_by_state(*spread, "initial.spread", model.state_names(),
                                 std::vector<double>(model.states.size(), 0.0), 0.0, kMaxState);
}

}  // namespace

void read_initial(const toml::table* table, Study* study) {
  const Model& model = *study->model;
  TableReader reader(table, study_table("initial"));
  Initial& initial = study->initial;
  initial.policy =
      static_cast<InitialPolicy>(reader.choice("policy", static_cast<std::size_t>(initial.policy)));
  const toml::table* state = reader.table("state");
  if (state != nullptr && reader.find("policy") == nullptr) initial.policy = InitialPolicy::fixed;
  if (state != nullptr && initial.policy != InitialPolicy::fixed) {
    fail_at(*state,
            fmt::format("state belongs to {}", choice_of({info_of(InitialPolicy::fixed).name})));
  }
  TableReader state_reader(state, "initial.state");
  for (std::size_t i = 0; i < model.states.size(); ++i) {
    initial.state[i] =
        state_reader.number(model.states[i].name, initial.state[i], -kMaxState, kMaxState);
  }
  state_reader.refuse_unknown();
  const bool chained = study->is_chained();
  if (const toml::node* along = reader.find("along"); along != nullptr && !chained) {
    fail_at(*along, fmt::format("along belongs to {}", choice_of(policy_names(true))));
  }
  const bool has_axes = !study->axes.empty();
  if (chained && has_axes) initial.along = reader.choice("along", 0, axis_names(*study));
  read_ensemble(&reader, study);
  reader.refuse_unknown();
  if (!chained || !has_axes) return;
  const Axis& along = study->axes[initial.along];
  if (along.sweeps_state()) {
    throw InputError(
        fmt::format("{}: a chain cannot go along axis '{}', {}; name a parameter's axis with "
                    "along = \"...\"",
                    place_of(*table), along.name,
                    along.is_list ? "which has initial states" : "an initial state"));
  }
}

}  // namespace gearsweep
