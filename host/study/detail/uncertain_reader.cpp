#include "study/detail/uncertain_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "model/error.hpp"
#include "study/detail/drawing_axis.hpp"
#include "study/detail/draws.hpp"
#include "study/detail/number_lines.hpp"
#include "study/detail/parameter_values.hpp"
#include "study/detail/swept_name.hpp"
#include "study/detail/toml_access.hpp"
#include "study/draw_quantities.hpp"

namespace gearsweep {
namespace {

constexpr const char* kUncertain = "uncertain";
constexpr std::size_t kMaxSampleBytes = std::size_t{16} << 20U;  // of a file of samples

enum Distribution : std::size_t { kNormal, kTriangular, kUniform, kValues };

// A distribution as the study gives it.
struct Tolerance {
  std::size_t distribution = kNormal;
  bool is_relative = false;
  bool is_folded = false;                   // normal: numbers below 0 lose their sign
  double mean = 0.0, std = 0.0;             // normal
  double from = 0.0, mode = 0.0, to = 0.0;  // uniform, triangular
  std::vector<double> samples;              // values

  double folded(double value) const { return is_folded ? std::abs(value) : value; }

  double quantile(double p) const {
    switch (distribution) {
      case kNormal:
        return folded(mean + std * normal_quantile(p));
      case kTriangular:
        return triangular_quantile(from, mode, to, p);
      case kUniform:
        return from + (to - from) * p;
      default:
        const auto place = static_cast<std::size_t>(p * static_cast<double>(samples.size()));
        return samples[std::min(place, samples.size() - 1)];
    }
  }
};

constexpr double kAnySize = 1e300;  // of numbers whose range the parameter gives

// nominal: what the parameter has without tolerance, where its own numbers are not relative to it.
Tolerance read_tolerance(const toml::table& table, const std::string& name, double nominal) {
  TableReader reader(&table, fmt::format("[uncertain] {}", name));
  Tolerance tolerance;
  const bool has_values = reader.find("values") != nullptr;
  if (!has_values && reader.find("distribution") == nullptr) {
    fail_at(table, fmt::format("{} needs a distribution, such as {} = {{distribution = "
                               "\"normal\", std = 0.01}}, or values or a file",
                               name, name));
  }
  tolerance.distribution = reader.choice("distribution", has_values ? kValues : kNormal,
                                         {"normal", "triangular", "uniform", "values"});
  tolerance.is_relative = reader.boolean("relative", false);
  const auto required = [&](const char* key) {
    if (reader.find(key) == nullptr) {
      fail_at(table, fmt::format("{} needs '{}'", name, key));
    }
    return reader.number(key, 0.0, -kAnySize, kAnySize);
  };
  if (tolerance.distribution == kNormal) {
    tolerance.mean =
        reader.number("mean", tolerance.is_relative ? 1.0 : nominal, -kAnySize, kAnySize);
    if (reader.find("std") == nullptr) fail_at(table, fmt::format("{} needs 'std'", name));
    tolerance.std = reader.number("std", 0.0, 0.0, kAnySize);
    tolerance.is_folded = reader.boolean("folded", false);
  } else if (tolerance.distribution == kValues) {
    if (!has_values) fail_at(table, fmt::format("{} needs 'values' or a 'file'", name));
    tolerance.samples = reader.numbers("values", -kAnySize, kAnySize);
    if (tolerance.samples.empty()) fail_at(table, fmt::format("{} has no values", name));
  } else {
    tolerance.from = required("from");
    tolerance.to = required("to");
    if (!(tolerance.to > tolerance.from)) {
      fail_at(table, fmt::format("{} goes from {} to {}; 'to' must be greater than 'from'", name,
                                 tolerance.from, tolerance.to));
    }
    if (tolerance.distribution == kTriangular) {
      tolerance.mode = required("mode");
      if (!(tolerance.mode >= tolerance.from && tolerance.mode <= tolerance.to)) {
        fail_at(table, fmt::format("{} has its mode at {}; it must lie between 'from' and 'to'",
                                   name, tolerance.mode));
      }
    }
  }
  reader.refuse_unknown();
  return tolerance;
}

// The draws of a parameter, the number `place` among all: of Saltelli's matrices A, then B, then
// for each parameter A with its column of B.
std::vector<double> draws_of(const Tolerance& tolerance, const std::string& name,
                             const Uncertain& uncertain, std::size_t place, std::size_t count) {
  const std::size_t samples = uncertain.samples;
  std::vector<double> out;
  const auto draw = [&](std::size_t row) {
    out.push_back(tolerance.quantile(uniform_at(uncertain.seed, name, row)));
  };
  for (std::size_t row = 0; row < uncertain.independent_draws(); ++row) draw(row);
  for (std::size_t other = 0; uncertain.sobol && other < count; ++other) {
    for (std::size_t row = 0; row < samples; ++row) draw(other == place ? samples + row : row);
  }
  return out;
}

// Each value of the parameter that a draw may make must be allowed.
void check_draws(const toml::node& place, const UncertainParameter& parameter,
                 std::pair<double, double> range, const Study& study) {
  const Axis& draws = parameter.draws;
  std::vector<double> bases = {1.0};
  if (parameter.is_factor) {
    const Swept* swept = study.find_on_axes(draws.index);
    bases = swept == nullptr ? std::vector{study.setting.parameters[draws.index]} : swept->values;
  }
  const auto [smallest, largest] = std::ranges::minmax(bases);
  for (std::size_t i = 0; i < draws.values.size(); ++i) {
    for (const double base : {smallest, largest}) {
      const double value = base * draws.values[i];
      if (value >= range.first && value <= range.second) continue;
      fail_at(place, fmt::format("draw {} of {} is {:g}, out of range; {:g} .. {:g} is allowed: "
                                 "take a narrower distribution, or one with ends",
                                 i + 1, draws.name, value, range.first, range.second));
    }
  }
}

// The one number that a key of [gear] has, or one of its pair. Without stiffness_factor the
// stiffness is once itself, without a phase of the runout that is 0.
double nominal_of_key(const SweptKey& swept, const toml::node& place) {
  const GearKey& key = *swept.key;
  const toml::node* node = swept.from.table->get(key.name);
  if (node == nullptr && key.name == kStiffnessFactor.name) return 1.0;
  if (node == nullptr && key.name == kRunoutPhase.name) return 0.0;
  if (node != nullptr && swept.member && node->is_array())
    node = node->as_array()->get(*swept.member);
  if (node == nullptr || !node->is_number()) {
    fail_at(place, fmt::format("{} is uncertain, but {} does not give it as one number",
                               swept.own_name(), swept.from.heading));
  }
  const double nominal = read_number(*node, std::string(key.name), key.min, key.max);
  // Whether a gear has such a fault decides what the period of the forcing is.
  if (nominal == 0.0 && (key.name == kRunout.name || key.name == kDamage.name)) {
    fail_at(place,
            fmt::format("{} is uncertain, and 0 in {}: give there what a usual gear has, above 0",
                        swept.own_name(), swept.from.heading));
  }
  return nominal;
}

void read_of_model(const toml::table& table, const std::string& name, std::size_t place,
                   std::size_t count, Study* study) {
  UncertainParameter parameter;
  Axis& draws = parameter.draws;
  draws.name = name;
  const std::pair<double, double> range =
      bind_swept(*study->model, table, "[uncertain] parameter", &draws);
  if (draws.is_state) {
    fail_at(table, fmt::format("[uncertain] is about parameters, and '{}' is a state; for random "
                               "starts there is [initial] ensemble",
                               name));
  }
  take_nominal_of_expression(table, draws.index, study);
  const Tolerance tolerance = read_tolerance(table, name, study->setting.parameters[draws.index]);
  parameter.is_factor = tolerance.is_relative;
  if (!parameter.is_factor && study->find_on_axes(draws.index) != nullptr) {
    fail_at(table, fmt::format("an axis gives {}: its tolerance must be relative to the values of "
                               "the axis, such as {} = {{distribution = \"normal\", std = 0.05, "
                               "relative = true}}",
                               name, name));
  }
  draws.values = draws_of(tolerance, name, study->uncertain, place, count);
  check_draws(table, parameter, range, *study);
  study->uncertain.parameters.push_back(std::move(parameter));
}

void refuse_given_elsewhere(const toml::table& table, const Axis& draws, const Study& study) {
  for (const Swept& column : draws.columns) {
    if (study.find_on_axes(column.index) != nullptr) {
      fail_at(table, fmt::format("{} and an axis both give {}", draws.name, column.name));
    }
    if (const DerivedParameter* derived = study.model->find_derived(column.index)) {
      fail_at(table, fmt::format("{} gives {}, and so does {} = {} ({})", draws.name, column.name,
                                 column.name, derived->expression, derived->place));
    }
  }
}

// Where several keys of a drawing vary, what follows from them is worked out in join_keys(): so few
// draws, the smallest and the largest among them, tell which parameters a key gives.
constexpr std::size_t kTelling = 64;

std::vector<double> telling(const std::vector<double>& draws) {
  if (draws.size() <= kTelling) return draws;
  const auto [min, max] = std::ranges::minmax(draws);
  std::vector<double> out(draws.begin(), draws.begin() + kTelling - 2);
  out.insert(out.end(), {min, max});
  return out;
}

void read_of_gear(const toml::table& root, const toml::table& table, const SweptKey& swept,
                  std::size_t place, std::size_t count, bool is_joined, Study* study) {
  const GearKey& key = *swept.key;
  if (swept.from.table == nullptr) {
    fail_at(table, fmt::format("'{}' is a key of {}, and the study has no such table", swept.name(),
                               swept.from.heading));
  }
  UncertainParameter parameter;
  Axis& draws = parameter.draws;
  draws.name = swept.name();
  draws.is_list = true;
  bind_key(key, &draws);
  const double nominal = nominal_of_key(swept, table);
  const Tolerance tolerance = read_tolerance(table, draws.name, nominal);
  draws.values = draws_of(tolerance, draws.name, study->uncertain, place, count);
  for (double& value : draws.values) {
    if (tolerance.is_relative) value *= nominal;
  }
  check_draws(table, parameter, {key.min, key.max}, *study);
  const GearValues others = first_values(root, *study->model, swept.from, study->axes);
  std::vector<double> all = draws.values;
  if (is_joined) draws.values = telling(all);
  add_parameters(swept, others, *study->model, table, &draws);
  draws.values = std::move(all);
  refuse_given_elsewhere(table, draws, *study);
  study->uncertain.parameters.push_back(std::move(parameter));
}

// What follows from several keys of a drawing follows from all of them at once.
void join_keys(const toml::table& root, const toml::table& table, Study* study) {
  std::map<std::string, std::vector<std::pair<SweptKey, Axis*>>> by_drawing;
  for (UncertainParameter& parameter : study->uncertain.parameters) {
    if (!parameter.draws.is_list) continue;
    const auto swept = find_swept_key(root, *study->model, parameter.draws.name);
    by_drawing[swept->from.suffix].emplace_back(*swept, &parameter.draws);
  }
  for (const auto& [suffix, keys] : by_drawing) {
    if (keys.size() < 2) continue;
    const DrawingTable& from = keys.front().first.from;
    join_parameters(keys, first_values(root, *study->model, from, study->axes), *study->model,
                    table);
    for (const auto& [key, axis] : keys) refuse_given_elsewhere(table, *axis, *study);
  }
}

// What a study may not draw, and what may be drawn in its place.
void refuse_measured(const toml::table& table) {
  for (const GearKey& key : kGearKeys) {
    const toml::node* node = table.get(key.name);
    if (node == nullptr || !key.is_measured()) continue;
    fail_at(*node,
            fmt::format("{} is a curve, which is one for all draws{}; or make a study for each "
                        "measured gear",
                        key.name,
                        key.form == KeyForm::tooth_list
                            ? ": what pitch errors have once per turn can be drawn, as "
                              "pinion_runout_um, gear_runout_um and their phases"
                            : ""));
  }
}

void refuse_given_twice(const toml::table& table, const Study& study) {
  std::vector<const Swept*> all;
  for (const UncertainParameter& parameter : study.uncertain.parameters) {
    for (const Swept& one : parameter.draws.swept()) {
      const bool is_there =
          std::ranges::any_of(all, [&](const Swept* other) { return other->index == one.index; });
      if (is_there) fail_at(table, fmt::format("two entries of [uncertain] give {}", one.name));
      all.push_back(&one);
    }
  }
}

}  // namespace

void take_in_sample_files(const StudyFiles& files, toml::table* study) {
  toml::table* uncertain = (*study)[kUncertain].as_table();
  if (uncertain == nullptr) return;
  for (auto&& [key, node] : *uncertain) {
    toml::table* table = node.as_table();
    const toml::node* file = table == nullptr ? nullptr : table->get("file");
    if (file == nullptr) continue;
    if (!file->is_string()) fail_at(*file, "file must be a name in quotes");
    if (table->contains("values")) fail_at(*file, "give values or a file, not both");
    toml::array numbers;
    const std::string path = files.path_of(*file);
    try {
      const std::string text = number_file_text(path, kMaxSampleBytes, "samples");
      NumberLines lines(text, kMaxSampleBytes, "samples", path);
      for (std::vector<std::string_view> fields; lines.next(&fields);) {
        const std::optional<double> number = number_in(fields.front());
        if (fields.size() != 1 || !number) lines.fail("one number in each line is expected");
        numbers.push_back(*number);
      }
    } catch (const InputError& error) {
      fail_at(*file, error.what());
    }
    table->erase("file");
    table->insert("values", std::move(numbers));
  }
}

namespace {

void read_options(TableReader* reader, Uncertain* uncertain) {
  uncertain->samples = reader->count("samples", kUsualSamples);
  uncertain->seed = reader->count("seed", uncertain->seed);
  uncertain->starts_at_nominal = reader->choice("start", 0, {"own", "nominal"}) == 1;
  uncertain->sobol = reader->boolean("sobol", uncertain->sobol);
  uncertain->keep = reader->boolean("keep", uncertain->keep);
  uncertain->percentiles = {5.0, 50.0, 95.0};
  if (const toml::node* percentiles = reader->find("percentiles")) {
    uncertain->percentiles = reader->numbers("percentiles", 0.0, 100.0);
    if (!std::ranges::is_sorted(uncertain->percentiles, std::ranges::less_equal())) {
      fail_at(*percentiles, "percentiles must increase");
    }
  }
}

void refuse_other_starts(const toml::table& table, const Study& study) {
  if (study.is_chained()) {
    fail_at(table,
            "uncertain parameters and an [initial] policy that goes on from neighbours: "
            "take policy = \"shifted\" or \"fixed\"");
  }
  if (study.initial.ensemble > 1) {
    fail_at(table, "uncertain parameters and an [initial] ensemble; a study has one of them");
  }
}

}  // namespace

void read_uncertain(const toml::table& root, Study* study) {
  const toml::node* node = root.get(kUncertain);
  if (node == nullptr) return;
  const toml::table& table = *node->as_table();
  TableReader reader(&table, study_table(kUncertain));
  read_options(&reader, &study->uncertain);
  const Model& model = *study->model;
  for (const ParameterInfo& info : model.parameters) reader.know(info.name);
  for (const ChannelInfo& info : model.states) reader.know(info.name);
  for (const SweptKey& swept : swept_keys(root, model)) reader.know(swept.name());
  refuse_measured(table);
  reader.refuse_unknown();
  std::vector<std::pair<std::string, const toml::table*>> entries;
  for (const auto& [key, entry] : table) {
    const std::string name(key.str());
    if (find_key(study_table(kUncertain), name) != nullptr) continue;
    if (!entry.is_table()) {
      fail_at(entry, fmt::format("{} must be a table, such as {} = {{distribution = \"normal\", "
                                 "std = 0.01}}",
                                 name, name));
    }
    entries.emplace_back(name, entry.as_table());
  }
  if (entries.empty()) {
    fail_at(table,
            "[uncertain] names no parameter, such as mu = {distribution = \"normal\", "
            "std = 0.01}");
  }
  refuse_other_starts(table, *study);
  std::map<std::string, std::size_t> keys_of_drawing;  // by its suffix
  for (const auto& [name, entry] : entries) {
    if (const auto swept = find_swept_key(root, model, name)) ++keys_of_drawing[swept->from.suffix];
  }
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const auto& [name, entry] = entries[i];
    // An entry may bind the study to another model.
    if (const auto swept = find_swept_key(root, *study->model, name)) {
      const bool is_joined = keys_of_drawing[swept->from.suffix] > 1;
      read_of_gear(root, *entry, *swept, i, entries.size(), is_joined, study);
    } else {
      read_of_model(*entry, name, i, entries.size(), study);
    }
  }
  join_keys(root, table, study);
  refuse_given_twice(table, *study);
  add_draw_quantities(study);
}

}  // namespace gearsweep
