#include "borders/border_setting.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "model/error.hpp"
#include "orbits/require_multipliers.hpp"
#include "plan/passive_states.hpp"
#include "plan/plan.hpp"

namespace gearsweep {
namespace {

constexpr double kMargin = 0.1;  // of the window: curves and differences reach a little beyond it

constexpr std::size_t kMinSettle = 64;  // periods: enough for orbits to be looked for

void require_plane(const Study& study) {
  if (study.axes.size() != 2) throw InputError("curves take a map of two axes");
  for (const Axis& axis : study.axes) {
    if (axis.values.size() < 2) {
      throw InputError(fmt::format("axis '{}' has one value: curves take two at least", axis.name));
    }
    if (!axis.columns.empty() && !axis.is_list) {
      throw InputError(fmt::format(
          "axis '{}' is a key of [gear], from which several parameters follow: curves take axes of "
          "one parameter each. Give the axis to a parameter instead, as omega for a speed; "
          "gearsweep model --study STUDY says what the key comes to",
          axis.name));
    }
    if (axis.is_list || !axis.columns.empty() || axis.is_state) {
      throw InputError(
          fmt::format("curves take axes of one parameter each; '{}' is none", axis.name));
    }
  }
}

void require_orbits(const Study& study) {
  require_multipliers(study);
  if (Plan(study, 1).is_autonomous()) {
    throw InputError(fmt::format(
        "nothing drives model '{}': its cycles have no period in forcing periods, by which curves "
        "are found; gearsweep floquet --along follows one of them",
        study.model->name));
  }
}

}  // namespace

BorderSetting make_border_setting(const Study& study, std::size_t steps) {
  require_plane(study);
  Study base = study;
  base.separate_points();
  require_orbits(base);
  base = without_passive_states(base);
  base.selection = select_quantities(*base.model, {"poincare"}, {base.model->states.front().name});
  base.integrate.record = 1;
  base.integrate.fp64 = true;
  base.integrate.stop = Stop::orbit;
  base.integrate.orbit_steps = 1;  // curves have steps of their own
  base.integrate.settle = std::max(base.integrate.settle, kMinSettle);
  base.integrate.tolerance = base.integrate.exponent_tolerance = 0.0;
  BorderSetting out{{base.model, base.setting, {}, {}, {}}, nullptr, nullptr};
  for (std::size_t i = 0; i < 2; ++i) {
    Axis& axis = base.axes[i];
    out.plane.parameters[i] = axis.index;
    out.plane.from[i] = axis.values.front();
    out.plane.to[i] = axis.values.back();
    const ParameterInfo& info = base.model->parameters[axis.index];
    const double margin = kMargin * out.plane.range(i);
    axis.values = {std::max(out.plane.from[i] - margin, info.min),
                   std::min(out.plane.to[i] + margin, info.max)};
  }
  Study finer = base;
  finer.integrate.steps_per_period =
      steps > 0 ? steps : std::max(kBorderSteps, base.integrate.steps_per_period);
  out.settling = std::make_shared<const Study>(std::move(base));
  out.following = std::make_shared<const Study>(std::move(finer));
  out.plane.model = out.following->model;
  return out;
}

}  // namespace gearsweep
