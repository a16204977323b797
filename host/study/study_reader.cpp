// read_study: TOML to a checked Study, from the outside in.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "model/error.hpp"
#include "model/names.hpp"
#include "study/detail/axis_reader.hpp"
#include "study/detail/curve_reader.hpp"
#include "study/detail/gear_files.hpp"
#include "study/detail/initial_reader.hpp"
#include "study/detail/integrate_reader.hpp"
#include "study/detail/model_table.hpp"
#include "study/detail/notices.hpp"
#include "study/detail/observe_reader.hpp"
#include "study/detail/overrides.hpp"
#include "study/detail/parameter_values.hpp"
#include "study/detail/point_reader.hpp"
#include "study/detail/rough_model.hpp"
#include "study/detail/spectrum_reader.hpp"
#include "study/detail/study_drawings.hpp"
#include "study/detail/study_files.hpp"
#include "study/detail/study_printer.hpp"
#include "study/detail/toml_access.hpp"
#include "study/detail/uncertain_reader.hpp"
#include "study/detail/zoom.hpp"
#include "study/draft.hpp"
#include "study/free_motions.hpp"
#include "study/nesting.hpp"
#include "study/own_step.hpp"
#include "study/study.hpp"

namespace gearsweep {
namespace {

constexpr double kMaxPoints = 1e8;
constexpr double kMaxNumbers = 1e9;  // in the result: 8 GB

toml::table parse(const std::string& text, const std::string& source) {
  if (std::all_of(text.begin(), text.end(), [](char c) { return c == ' ' || c == '\n'; })) {
    throw InputError(
        fmt::format("{}: the file is empty; 'gearsweep studies NAME' prints a study "
                    "to start from",
                    source));
  }
  if (text.find('\0') != std::string::npos) {
    throw InputError(fmt::format("{}: not a text file; a study is TOML text", source));
  }
  refuse_deep_keys(text, source);
  try {
    return toml::parse(text, source);
  } catch (const toml::parse_error& error) {
    throw InputError(fmt::format("{}:{}: not valid TOML: {}", source, error.source().begin.line,
                                 error.description()));
  }
}

// Before its curves are there, a force that is read from them is 0, and there is no contact to
// observe.
void bind_curves(const toml::table* model, const std::vector<StudyDrawing>& drawings,
                 Study* study) {
  Binding binding = study->model->binding;
  binding.curves = read_given_curves(model, *study->model);
  for (const StudyDrawing& drawing : drawings) {
    binding.curves.insert(drawing.gives.curves.begin(), drawing.gives.curves.end());
  }
  if (!binding.curves.empty()) study->bind(binding);
}

// The model with the study's options, which reads its measured curves.
void bind_model(const toml::table* model, const std::vector<StudyDrawing>& drawings, Study* study) {
  Binding binding{
      read_given_curves(model, *study->model), study->setting.options, {}, study->expressions};
  for (const StudyDrawing& drawing : drawings) {
    binding.curves.insert(drawing.gives.curves.begin(), drawing.gives.curves.end());
  }
  const auto add = [&](const Axis& axis) {
    for (const Swept& swept : axis.swept()) {
      if (!swept.is_state) binding.parameters.insert(study->model->parameters[swept.index].name);
    }
  };
  for (const Axis& axis : study->axes) add(axis);
  for (const UncertainParameter& parameter : study->uncertain.parameters) add(parameter.draws);
  study->bind(binding);
}

// What the model has and does nothing with, now that it has the study's expressions; before the
// other notices.
void note_unused(Study* study) {
  std::vector<std::string> notices;
  for (const UnusedName& unused : study->model->unused) {
    notices.push_back(fmt::format("{}: {} '{}' is used nowhere: its value changes nothing",
                                  unused.place, unused.kind, unused.name));
  }
  study->notices.insert(study->notices.begin(), notices.begin(), notices.end());
}

// The model with the study's own limits of its states.
void bind_limits(const toml::table* integrate, Study* study) {
  const toml::node* node = integrate == nullptr ? nullptr : integrate->get("diverged_above");
  if (node == nullptr) return;
  const StudyKey& key = *find_key(study_table("integrate"), "diverged_above");
  Model limited = *study->model;
  limited.diverged_above = read_by_state(*node, "integrate.diverged_above", limited.state_names(),
                                         limited.diverged_above, key.min, key.max);
  study->own_model = std::make_shared<const Model>(std::move(limited));
  study->model = study->own_model.get();
}

// There must be a first one among the points that the study names a start of.
void check_starts(const toml::table& root, const Study& study) {
  const auto check = [&](const toml::node& place, std::size_t state, double start) {
    if (std::abs(start) < study.model->diverged_above[state]) return;
    fail_at(place, fmt::format("{} = {} is a start beyond {}, where a motion counts as diverged "
                               "(integrate.diverged_above)",
                               study.model->states[state].name, start,
                               study.model->diverged_above[state]));
  };
  for (std::size_t i = 0; i < study.initial.state.size(); ++i) {
    const toml::table* initial = root["initial"].as_table();
    if (initial != nullptr) check(*initial, i, study.initial.state[i]);
  }
  for (const Axis& axis : study.axes) {
    const toml::node* place = root.get(axis.is_list ? "points" : "axes");
    if (place == nullptr) continue;  // the axis of a study without any
    for (const Swept& swept : axis.swept()) {
      for (const double start : swept.values) {
        if (swept.is_state) check(*place, swept.index, start);
      }
    }
  }
}

// A key that a table has, but not the study itself: a parameter without [parameters] before it, or
// --set mu=0.1.
void refuse_misplaced(const toml::table& root, const Model& model) {
  const StudyTable& study = study_table("");
  for (const auto& [key, node] : root) {
    const std::string name(key.str());
    if (find_key(study, name) != nullptr) continue;
    const std::vector<std::string> paths =
        paths_of_key(name, names_of(model.options), names_of(model.parameters));
    if (paths.empty()) continue;
    fail_at(node, fmt::format("unknown key '{}' in {}; did you mean '{}'?", name, study.heading,
                              fmt::join(paths, "' or '")));
  }
}

void check_attractors(const toml::table& root, const Study& study) {
  const toml::table* observe = root["observe"].as_table();
  if (study.selection.census && study.integrate.orbit_steps > 1) {
    fail_at(*root["integrate"]["orbit_steps"].node(),
            "attractors are told apart by where motions are, for which all must have the same "
            "steps: leave out integrate.orbit_steps, or the quantities attractor and "
            "attractor_count");
  }
  for (const Quantity& quantity : study.selection.quantities) {
    if (quantity.name != "attractor_count" || study.initial.ensemble > 1) continue;
    fail_at(*observe->get("quantities"),
            "'attractor_count' counts over an ensemble of initial states: give it a size, "
            "[initial] ensemble = 8, for example");
  }
}

void check_size(const toml::table& root, const Study& study) {
  if (study.axes.empty()) return;
  double points = 1.0;
  for (const Axis& axis : study.axes) points *= static_cast<double>(axis.values.size());
  const auto members = static_cast<double>(study.members());
  if (points * members > kMaxPoints) {
    fail_at(*root.get(root.contains("axes") ? "axes" : "points"),
            fmt::format("the axes span {:.3g} points{}; at most {:.0g} are possible", points,
                        members > 1.0 ? fmt::format(" of {} trajectories each", members) : "",
                        kMaxPoints));
  }
  // A census keeps the place of each trajectory, and the errors of that, until all are there.
  const double places = study.selection.census
                            ? members * 4.0 * static_cast<double>(study.model->states.size())
                            : 0.0;
  const double draws =
      static_cast<double>(study.uncertain.draws() * study.selection.quantities.size());
  const double numbers =
      points * (static_cast<double>(study.selection.quantities.size() + 1 +
                                    study.selection.poincare.size() * study.integrate.record) +
                places + draws);
  if (numbers > kMaxNumbers) {
    throw InputError(
        fmt::format("{}: the maps would hold {:.3g} numbers; at most {:.0g} are "
                    "possible: sample fewer states or periods (integrate.record), leave out "
                    "'poincare', or take a smaller initial.ensemble or uncertain.samples",
                    place_of(root), numbers, kMaxNumbers));
  }
}

// A model without forcing counts time in periods of about one return to its first section, of so
// many steps of its own, so that chaos does not make a different clock of each rounding; or, where
// nothing returns, in periods of 128 such steps. A return of very many, as of a cycle that is slow
// beside its fastest rate, is several periods: a longer one would be refused.
void wind_clock(double return_time, double step, Study* study) {
  constexpr double kMostSteps = 4096.0;
  const double steps = return_time / step;
  study->clock_reason = steps > kMostSteps ? "a part of a return"
                        : steps > 0.0      ? "about a return"
                                           : "128 steps, since no motion looked at comes back, so "
                                             "that averages and extremes may be of a part of it";
  Binding binding = study->model->binding;
  binding.clock = step * (steps > 0.0 ? std::clamp(rounded_up(steps), 16.0, kMostSteps) : 128.0);
  study->bind(binding);
}

// Judges the motions of a model without forcing by the maxima of another state where those of its
// own tell nothing. Returns the time that they take to come back; 0: they do not.
double look_at_returns(Study* study) {
  const std::vector<SectionInfo>& sections = study->model->sections;
  const bool is_own = sections.size() == 1 && sections.front().is_own;
  const FreeMotions seen = look_at_free_motions(*study, is_own, !sections.empty());
  if (!seen.better_state) return seen.return_time;
  Binding binding = study->model->binding;
  binding.looked_at = seen.better_state;
  study->bind(binding);
  return look_at_free_motions(*study, false, true).return_time;
}

// The step of a study that names none, and the clock of a model that has none.
void find_steps(Study* study) {
  const Integrate& given = study->integrate;
  const bool needs_step = given.max_step == 0.0 && given.steps_per_period == 0;
  const bool needs_clock = study->model->is_clockless;
  const double models = study->model->max_step;
  std::optional<OwnStep> own;
  if (needs_step || (needs_clock && models == 0.0)) own = find_own_step(*study);
  if (needs_clock) wind_clock(look_at_returns(study), models > 0.0 ? models : own->longest, study);
  if (!needs_step) return;
  study->integrate.max_step = needs_clock ? own->longest : own->step;  // that divides the clock
  study->step_reason = own->reason;
  study->step_reach = own->reach;
}

// A study as TOML, with all that lies in files taken in.
struct StudyText {
  toml::table root;
  PointTable points;
};

StudyText take_in(const std::string& text, const std::string& source,
                  const std::vector<std::string>& overrides, const std::vector<std::string>& zooms,
                  const PointTable& given_points, NamedFiles named) {
  StudyText study{parse(text, source), {}};
  const StudyFiles files(source, named);
  for (const std::string& assignment : overrides) apply_override(assignment, &study.root);
  for (const std::string& zoom : zooms) apply_zoom(zoom, &study.root);
  take_in_model_file(files, &study.root);
  take_in_curve_files(files, &study.root);
  take_in_gear_files(files, &study.root);
  study.points = take_in_points(files, given_points, &study.root);
  take_in_sample_files(files, &study.root);
  // As axes=[] takes them away, and uncertain={} the tolerances.
  if (const toml::array* axes = study.root["axes"].as_array(); axes != nullptr && axes->empty()) {
    study.root.erase("axes");
  }
  const toml::table* uncertain = study.root["uncertain"].as_table();
  if (uncertain != nullptr && uncertain->empty()) study.root.erase("uncertain");
  return study;
}

void refuse_without_axes(const StudyText& text) {
  throw InputError(
      fmt::format("{}: the study has no axes; give one or two, as in\n"
                  "  [[axes]]\n  name = \"omega\"\n  from = 0.4\n  to = 2.0\n  count = 100\n"
                  "or a list of points:\n  [points]\n  file = \"points.csv\"",
                  place_of(text.root)));
}

// Axes may be missing.
Study read_tables(const StudyText& text) {
  const toml::table& root = text.root;
  Study study;
  TableReader reader(&root, study_table(""));
  study.title = reader.text("title", "");
  read_model(root, reader.table("model"), &study);
  const toml::table* parameters = reader.table("parameters");
  reader.table("gear");
  reader.table("sections");  // read_model()
  reader.table("points");
  reader.table("uncertain");
  refuse_misplaced(root, *study.model);
  reader.refuse_unknown();

  study.axes = read_axes(root, text.points, *study.model);
  read_spectrum(root, &study);
  const std::vector<StudyDrawing> drawings = read_drawings(root, &study);
  take_in_gear(root, *study.model, &study.axes);
  read_parameters(parameters, &study);
  bind_expressions(&study);
  refuse_idle_axes(root, study);
  read_initial(reader.table("initial"), &study);
  read_integrate(reader.table("integrate"), &study);
  bind_curves(root["model"].as_table(), drawings, &study);
  read_observe(reader.table("observe"), root, &study);
  check_attractors(root, study);
  heed_rough_model(root, &study);
  read_uncertain(root, &study);
  // A study of uncertain parameters needs no axes: it is that of its one point.
  if (study.axes.empty() && study.uncertain.draws() > 0) study.axes.push_back(resting_axis(study));
  check_size(root, study);
  note_what_wins(root, drawings, &study);
  bind_model(root["model"].as_table(), drawings, &study);
  note_unused(&study);
  note_what_the_model_says(&study);
  bind_limits(root["integrate"].as_table(), &study);
  check_starts(root, study);

  find_steps(&study);
  study.toml = print_study(root);
  return study;
}

}  // namespace

std::string Study::brief_toml() const {
  if (std::ranges::none_of(axes, &Axis::is_list)) return toml;
  return print_study(without_numbers(parse(toml, "the study")));
}

Study read_study(const std::string& text, const std::string& source,
                 const std::vector<std::string>& overrides, const std::vector<std::string>& zooms,
                 const PointTable& points, NamedFiles files) {
  const StudyText whole = take_in(text, source, overrides, zooms, points, files);
  Study study = read_tables(whole);
  if (study.axes.empty()) refuse_without_axes(whole);
  return study;
}

Study read_draft(const std::string& text, const std::string& source,
                 const std::vector<std::string>& overrides, const PointTable& points) {
  return read_tables(take_in(text, source, overrides, {}, points, NamedFiles::allowed));
}

}  // namespace gearsweep
