#include "study/detail/rough_model.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "study/detail/toml_access.hpp"

namespace gearsweep {
namespace {

std::string told(const StateJump& jump) {
  return fmt::format("{} jumps with a state (in {})", jump.expression, jump.place);
}

// Whether it needs tangent vectors, or states that return to within a small tolerance.
bool rests_on_smoothness(const Observer& observer) {
  return observer.tangents > 0 ||
         std::ranges::any_of(observer.observable->outputs, [](const ObservableOutput& output) {
           return output.role == OutputRole::period || output.role == OutputRole::settled;
         });
}

void refuse_quantities(const toml::table& root, const StateJump& jump, const Study& study) {
  for (const Quantity& quantity : study.selection.quantities) {
    const Selection alone = select_quantities(*study.model, {quantity.name}, {});
    if (std::ranges::none_of(alone.observers, rests_on_smoothness)) continue;
    fail_at(
        *root["observe"]["quantities"].node(),
        fmt::format("'{}' is not for model '{}': {}, so that steps are of first order there and "
                    "tangent vectors miss the jump; ask for means, extremes, sections or "
                    "zero_one, or round the jump off, as tanh(v/0.01) does with sign(v)",
                    quantity.name, study.model->name, told(jump)));
  }
}

void refuse_tolerance(const toml::table& root, const StateJump& jump) {
  for (const char* key : {"tolerance", "exponent_tolerance"}) {
    const toml::node* node = root["integrate"][key].node();
    if (node == nullptr || node->value_or(0.0) == 0.0) continue;
    fail_at(*node,
            fmt::format("{} is judged by periodic orbits, which are not found here: {}; give "
                        "integrate.max_step instead",
                        key, told(jump)));
  }
}

}  // namespace

void heed_rough_model(const toml::table& root, Study* study) {
  const std::vector<StateJump> jumps = study->model->state_jumps(study->setting);
  if (!jumps.empty()) {
    refuse_quantities(root, jumps.front(), *study);
    refuse_tolerance(root, jumps.front());
    study->integrate.tolerance = 0.0;
    study->integrate.exponent_tolerance = 0.0;
    study->integrate.stop = Stop::never;
    study->accuracy = fmt::format("steps are of first order where {}", told(jumps.front()));
    if (jumps.size() > 1) study->accuracy += fmt::format(", and at {} more", jumps.size() - 1);
    study->notices.push_back(fmt::format("model '{}': {}: half the step, half the error",
                                         study->model->name, study->accuracy));
    return;
  }
  const std::vector<std::string>& corners = study->model->uncorrected;
  if (corners.empty()) return;
  study->accuracy = fmt::format("steps are of second order where {} bends, which is not corrected",
                                corners.front());
  if (corners.size() > 1) study->accuracy += fmt::format("; so do {} more", corners.size() - 1);
  study->notices.push_back(fmt::format("model '{}': {}", study->model->name, study->accuracy));
}

}  // namespace gearsweep
