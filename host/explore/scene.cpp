#include "explore/scene.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "model/error.hpp"
#include "plan/study_points.hpp"
#include "plan/view_points.hpp"
#include "point/place.hpp"
#include "point/point_trace.hpp"

namespace gearsweep {
namespace {

// Beyond either end of the first view, in views.
constexpr double kBeyond = 1.5;

struct Range {
  double low = 0.0, high = 0.0;
};

// An axis as a scene has it: the first view, and the range that cells are counted on.
struct SceneAxis {
  std::string name;
  bool logarithmic = false;
  Range view, world;
};

// A world that reaches beyond the view as far as the parameter may go, and never to another sign:
// at 0 a frequency has no period, and much else no meaning.
Range world_of(const Range& view, bool logarithmic, const Range& allowed) {
  Range world;
  if (logarithmic) {
    const double way = std::pow(view.high / view.low, kBeyond);
    world = {view.low / way, view.high * way};
  } else {
    const double way = kBeyond * (view.high - view.low);
    world = {view.low - way, view.high + way};
    if (view.low > 0.0 && world.low <= 0.0) world.low = 0.25 * view.low;
    if (view.high < 0.0 && world.high >= 0.0) world.high = 0.25 * view.high;
    if (view.low == 0.0) world.low = 0.0;
  }
  return {std::max(world.low, allowed.low), std::min(world.high, allowed.high)};
}

Range allowed_of(const Model& model, const std::string& name) {
  const int index = model.find_parameter(name);
  if (index < 0) return {-HUGE_VAL, HUGE_VAL};
  const ParameterInfo& info = model.parameters[static_cast<std::size_t>(index)];
  return {info.min, info.max};
}

SceneAxis as_it_is(const Axis& axis, const Model& model) {
  SceneAxis out = {axis.name, axis.logarithmic, {axis.values.front(), axis.values.back()}, {}};
  out.world = world_of(out.view, out.logarithmic, allowed_of(model, axis.name));
  return out;
}

// From half of what the study has of a parameter to half as much again; of a state where motions
// go.
SceneAxis another(const ExploredStudy& base, const std::string& name) {
  const Study& study = base.study;
  const Model& model = *study.model;
  SceneAxis out = {name, false, {}, {}};
  if (const int state = model.find_state(name); state >= 0) {
    const StateRange range = base.state_ranges->of(study)[static_cast<std::size_t>(state)];
    out.view = {range.low, range.high};
  } else {
    const Range allowed = allowed_of(model, name);
    const int index = model.find_parameter(name);
    if (index < 0) {
      throw InputError(
          fmt::format("'{}' is neither a parameter nor a state of model '{}'", name, model.name));
    }
    const double value = study.setting.parameters[static_cast<std::size_t>(index)];
    const Range wanted = value == 0.0  ? Range{0.0, 1.0}
                         : value > 0.0 ? Range{0.5 * value, 1.5 * value}
                                       : Range{1.5 * value, 0.5 * value};
    out.view = {std::clamp(wanted.low, allowed.low, allowed.high),
                std::clamp(wanted.high, allowed.low, allowed.high)};
    if (out.view.low == out.view.high) out.view = allowed;
  }
  out.world = world_of(out.view, false, allowed_of(model, name));
  return out;
}

SceneAxis find_axis(const ExploredStudy& base, std::size_t number, const std::string& name) {
  for (const Axis& axis : base.study.axes) {
    if (axis.name == (name.empty() ? base.study.axes[number].name : name)) {
      return as_it_is(axis, *base.study.model);
    }
  }
  return another(base, name);
}

std::string as_toml(const SceneAxis& axis, const Range& range) {
  return fmt::format("{{name = \"{}\", from = {}, to = {}, count = 3, scale = \"{}\"}}", axis.name,
                     range.low, range.high, axis.logarithmic ? "log" : "linear");
}

// The axis of a key of [gear] stands for the parameter that follows from it, where that is one:
// 'pinion_speed_rpm' for 'omega'.
Axis of_one_number(const Axis& axis, std::vector<std::string>* notices) {
  if (axis.columns.empty() && !axis.is_list) return axis;
  if (axis.is_list || axis.columns.size() > 1) {
    throw InputError(fmt::format(
        "explore takes axes of one parameter or state each; '{}' stands for several", axis.name));
  }
  Axis own;
  static_cast<Swept&>(own) = axis.columns.front();
  own.logarithmic = axis.logarithmic;
  notices->push_back(
      fmt::format("'{}' is swept as '{}', which follows from it", axis.name, own.name));
  return own;
}

// Up to two: parameters that are not 0, in the model's order, then states.
void add_axes(const ExploredStudy& base, std::vector<SceneAxis>* axes,
              std::vector<std::string>* notices) {
  const Model& model = *base.study.model;
  const auto add = [&](const std::string& name) {
    const bool is_there = std::ranges::find(*axes, name, &SceneAxis::name) != axes->end();
    if (is_there || axes->size() == 2) return;
    axes->push_back(another(base, name));
    notices->push_back(fmt::format("'{}' is swept, too: a map has two axes", name));
  };
  for (std::size_t i = 0; i < model.parameters.size(); ++i) {
    if (base.study.setting.parameters[i] != 0.0 && model.find_derived(i) == nullptr) {
      add(model.parameters[i].name);
    }
  }
  for (const ChannelInfo& state : model.states) add(state.name);
  if (axes->size() == 2) return;
  throw InputError("explore shows maps over two axes, and nothing else could be swept");
}

constexpr const char* kExponentError = "lyapunov_max_error";

bool offers(const Model& model, const std::string& quantity) {
  const std::vector<Quantity> offered = offered_quantities(model);
  return std::ranges::find(offered, quantity, &Quantity::name) != offered.end();
}

std::vector<std::string> quantities_of_points(const Study& study,
                                              std::vector<std::string>* notices) {
  std::vector<std::string> kept, left;
  for (const Quantity& quantity : study.selection.quantities) {
    const bool is_of_all = quantity.of_census || quantity.of_draws || quantity.width != 1;
    (is_of_all ? left : kept).push_back(quantity.name);
  }
  if (!study.selection.poincare.empty()) left.emplace_back("poincare");
  if (!left.empty()) {
    notices->push_back(
        fmt::format("left out, since a point has none of its own: {}", fmt::join(left, ", ")));
  }
  if (kept.empty()) kept = {"motion_class", "period", "lyapunov_max"};
  // How far to trust its colours.
  const auto has = [&](const std::string& name) {
    return std::ranges::find(kept, name) != kept.end();
  };
  if (has("lyapunov_max") && !has(kExponentError) && offers(*study.model, kExponentError)) {
    kept.emplace_back(kExponentError);
  }
  return kept;
}

Study with_values(Study study, const std::array<std::vector<double>, 2>& values) {
  for (std::size_t i = 0; i < 2; ++i) study.axes[i].values = values[i];
  return study;
}

// Reads the text of a scene's study anew, with other things to observe and the same step.
Study observing(const Study& study, const std::vector<std::string>& overrides) {
  std::vector<std::string> all = overrides;
  // What tells attractors apart refuses others; they are set below.
  if (study.integrate.orbit_steps > 1) all.emplace_back("integrate.orbit_steps=1");
  Study out = read_study(study.toml, "the page", all, {}, {}, NamedFiles::refused);
  out.integrate = study.integrate;
  FoundStep::of(study).give_to(&out);
  out.separate_points();
  return out;
}

// Samples of every state, and these quantities.
Study with_samples(const Study& study, std::vector<std::string> names) {
  names.emplace_back("poincare");
  std::vector<std::string> overrides = {
      fmt::format("observe.quantities=[\"{}\"]", fmt::join(names, "\", \"")),
      fmt::format("observe.poincare=[\"{}\"]", fmt::join(study.model->state_names(), "\", \""))};
  // Without forcing there is no phase to sample at.
  if (study.model->is_clockless && study.selection.section.empty() &&
      !study.model->sections.empty()) {
    overrides.push_back(fmt::format("observe.section=\"{}\"", study.model->sections.front().name));
  }
  return observing(study, overrides);
}

// A motion that rests comes to no section.
void add_place_of_rest(const Model& model, std::vector<std::string>* names) {
  std::vector<std::string> wanted = {"motion_class"};
  for (const ChannelInfo& state : model.states) wanted.push_back(state.name + "_mean");
  for (const std::string& name : wanted) {
    if (std::ranges::find(*names, name) == names->end()) names->push_back(name);
  }
}

// The start of every point where a page has moved one state's: the others keep the study's own.
std::string start_override(const Study& study, const std::vector<NamedValue>& moved) {
  std::vector<double> state = start_of_policy(study, study.setting);
  for (const auto& [name, value] : moved) {
    state[static_cast<std::size_t>(study.model->find_state(name))] = value;
  }
  std::vector<std::string> told;
  for (std::size_t i = 0; i < state.size(); ++i) {
    told.push_back(fmt::format("{} = {}", study.model->states[i].name, state[i]));
  }
  return fmt::format("initial={{policy = \"fixed\", state = {{{}}}}}", fmt::join(told, ", "));
}

// A hash is enough: keys are compared with those of the same server alone.
std::string short_text(const std::string& text) {
  return fmt::format("{:016x}", std::hash<std::string>{}(text));
}

}  // namespace

std::vector<std::string> overrides_of(const Study& base, const std::vector<NamedValue>& sets) {
  std::vector<std::string> overrides;
  std::vector<NamedValue> starts;
  for (const NamedValue& set : sets) {
    if (base.model->find_state(set.name) >= 0) {
      starts.push_back(set);
      continue;
    }
    const std::size_t index = parameter_index(*base.model, set.name, "");
    require_in_range(base.model->parameters[index], set.value, "");
    overrides.push_back(fmt::format("parameters.{}={}", set.name, set.value));
  }
  if (!starts.empty()) overrides.push_back(start_override(base, starts));
  return overrides;
}

Scene::Scene(const ExploredStudy& base, const SceneChanges& changes)
    : changes_(changes), state_ranges_(base.state_ranges) {
  const std::array<SceneAxis, 2> axes = {find_axis(base, 0, changes.x),
                                         find_axis(base, 1, changes.y)};
  if (axes[0].name == axes[1].name) {
    throw InputError(fmt::format("'{}' is on both axes; give the other one, too", axes[0].name));
  }
  std::vector<std::string> overrides = {fmt::format(
      "axes=[{}, {}]", as_toml(axes[0], axes[0].world), as_toml(axes[1], axes[1].world))};
  const std::vector<std::string> sets = overrides_of(base.study, changes.sets);
  overrides.insert(overrides.end(), sets.begin(), sets.end());
  study_ = read_study(base.study.toml, "the page", overrides, {}, {}, NamedFiles::refused);
  settle_step(base.pilot_step, &study_);
  study_.separate_points();
  for (const std::string& notice : base.study.notices) {
    if (std::ranges::find(study_.notices, notice) == study_.notices.end()) {
      study_.notices.push_back(notice);
    }
  }
  const auto is_start = [&](const NamedValue& set) {
    return base.study.model->find_state(set.name) >= 0;
  };
  if (std::ranges::any_of(changes.sets, is_start)) {
    study_.notices.emplace_back(
        "every point starts from the same state, since an initial state was moved");
  }
  key_ = short_text(study_.toml);
  for (std::size_t i = 0; i < 2; ++i) {
    first_view_[i] = {axes[i].view.low, axes[i].view.high};
    study_.axes[i].values = {axes[i].world.low, axes[i].world.high};
  }
}

double Scene::value_at(std::size_t axis, std::uint64_t k, std::size_t depth) const {
  return value_at(axis, std::ldexp(static_cast<double>(k), -static_cast<int>(depth)));
}

double Scene::value_at(std::size_t axis, double share) const {
  return value_at_share(study_.axes[axis], share);
}

double Scene::share_of(std::size_t axis, double value) const {
  const Axis& along = study_.axes[axis];
  const double low = along.values.front(), high = along.values.back();
  if (along.logarithmic) return std::log(value / low) / std::log(high / low);
  return (value - low) / (high - low);
}

std::vector<double> Scene::start() const { return start_of_policy(study_, study_.setting); }

Study Scene::at(const std::array<std::vector<double>, 2>& values) const {
  return with_values(study_, values);
}

Study Scene::sampled_at(const std::array<std::vector<double>, 2>& values) const {
  std::call_once(sampled_.is_read, [&] {
    std::vector<std::string> names;
    for (const Quantity& quantity : study_.selection.quantities) names.push_back(quantity.name);
    if (study_.model->is_clockless) add_place_of_rest(*study_.model, &names);
    sampled_.study = with_samples(study_, names);
  });
  return with_values(sampled_.study, values);
}

Study Scene::census() const {
  std::call_once(census_.is_read, [&] { census_.study = with_samples(study_, {"attractor"}); });
  return census_.study;
}

Study explorable(const Study& study) {
  std::vector<SceneAxis> axes;
  std::vector<std::string> notices;
  for (const Axis& axis : study.axes) {
    axes.push_back(as_it_is(of_one_number(axis, &notices), *study.model));
  }
  add_axes({study, std::nullopt}, &axes, &notices);
  const std::vector<std::string> quantities = quantities_of_points(study, &notices);
  std::vector<std::string> overrides = {
      fmt::format("observe.quantities=[\"{}\"]", fmt::join(quantities, "\", \""))};
  const bool has_other_axes =
      !std::ranges::equal(axes, study.axes, {}, &SceneAxis::name, &Axis::name);
  if (has_other_axes) {
    overrides.push_back(fmt::format("axes=[{}, {}]", as_toml(axes[0], axes[0].view),
                                    as_toml(axes[1], axes[1].view)));
  }
  Study alone = read_study(study.toml, "the study", overrides);
  if (alone.is_chained() || alone.members() > 1) {
    notices.emplace_back(
        "each point starts on its own, and once: the study's chain, ensemble or tolerances are "
        "left out");
  }
  // What tells how samples are taken is for the diagram, which has them.
  std::erase_if(alone.notices, [](const std::string& notice) {
    return notice.find("says how 'poincare' is sampled") != std::string::npos;
  });
  alone.notices.insert(alone.notices.end(), notices.begin(), notices.end());
  return alone;
}

}  // namespace gearsweep
