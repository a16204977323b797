#include "result/dataset.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "model/names.hpp"
#include "result/detail/attractor_list.hpp"
#include "result/detail/dataset_file.hpp"
#include "result/detail/derived_coordinates.hpp"
#include "result/detail/file_names.hpp"
#include "result/detail/file_notes.hpp"
#include "result/detail/spectrum_numbers.hpp"
#include "result/result_size.hpp"
#include "study/draw_quantities.hpp"
#include "sweep_types.h"

namespace gearsweep {
namespace {

constexpr const char* kComponents = "component";  // the dimension of quantities of every state

// 1, 2, ...
std::vector<double> numbers_to(std::size_t last) {
  std::vector<double> numbers(last);
  std::iota(numbers.begin(), numbers.end(), 1.0);
  return numbers;
}

// Puts the dataset together, variable by variable.
class Description {
 public:
  explicit Description(const SweepResult& result)
      : result_(result), study_(result.study), notes_(result.study, names_of(result.study.axes)) {}

  Dataset make(const Provenance& provenance) {
    add_provenance(provenance);
    for (auto axis = study_.axes.rbegin(); axis != study_.axes.rend(); ++axis) add_axis(*axis);
    for (const DerivedCoordinate& one : derived_coordinates(study_)) add_derived(one);
    add_status();
    for (std::size_t i = 0; i < study_.selection.quantities.size(); ++i) {
      add_quantity(study_.selection.quantities[i], result_.values[i]);
    }
    if (study_.spectrum) add_spectrum();
    if (study_.uncertain.keep) add_draws();
    if (study_.selection.census) {
      add_numbered(kAttractorNumber, result_.attractors.size());
      add_attractors(result_, notes_, &out_);
    }
    if (!study_.selection.poincare.empty()) add_poincare();
    return std::move(out_);
  }

 private:
  void add_provenance(const Provenance& provenance) {
    out_.attributes = notes_.provenance(provenance);
    const auto add = [&](const char* name, auto value) {
      out_.attributes.push_back({name, std::move(value)});
    };
    add("device", result_.engine.device);
    add("driver", result_.engine.driver);
    add("kernel_macros", result_.engine.macros);
    add("integration_steps", result_.steps);
    add("stopped_trajectories", static_cast<double>(result_.stopped));
    add("compute_seconds", result_.seconds);
    add("kernel_seconds", result_.kernel_seconds);
    add("integrated_states", fmt::format("{}", fmt::join(result_.integrated, " ")));
    if (!result_.pilot) return;
    add("pilot_max_step", result_.pilot->step.max_step);
    add("pilot_orbit_steps", static_cast<double>(result_.pilot->step.orbit_steps));
    add("pilot_error", result_.pilot->error);
    add("pilot_kept", result_.pilot->kept);
    add("pilot_sensitive", result_.pilot->sensitive);
    add("pilot_sensitive_max", result_.pilot->max_sensitive);
    add("pilot_points", static_cast<double>(result_.pilot->points));
  }

  void add_axis(const Axis& axis) {
    const std::string name = axis.is_list ? kPointAxis : name_in_result(axis, study_);
    out_.dimensions.push_back({name, axis.values.size()});
    map_dimensions_.push_back(name);
    DataVariable variable = coordinate(axis, name, name);
    variable.attributes.push_back({"scale", axis.logarithmic ? "log" : "linear"});
    out_.variables.push_back(std::move(variable));
    for (const std::string& listed : axis.listed) add_column(*axis.find_column(listed), name);
    for (const Swept& column : axis.columns) {
      const bool is_there = std::ranges::find(axis.listed, column.name) != axis.listed.end();
      if (!is_there) add_column(column, name);
    }
  }

  void add_column(const Swept& column, const std::string& dimension) {
    DataVariable variable = coordinate(column, name_in_result(column, study_), dimension);
    variable.attributes.push_back(column.follows.empty() ? Attribute{kSweeps, column.name}
                                                         : Attribute{kFollows, column.follows});
    columns_ += (columns_.empty() ? "" : " ") + variable.name;
    out_.variables.push_back(std::move(variable));
  }

  void add_derived(const DerivedCoordinate& derived) {
    const std::string name = name_in_result(derived.parameter, study_);
    std::vector<std::string> dimensions;  // (y, x), as those of maps
    for (auto axis = derived.axes.rbegin(); axis != derived.axes.rend(); ++axis) {
      dimensions.push_back(map_dimensions_[study_.axes.size() - 1 - *axis]);
    }
    DataVariable variable = {
        .name = name,
        .stored = Stored::real,
        .dimensions = std::move(dimensions),
        .attributes = notes_.describe(derived.parameter.unit, derived.parameter.meaning),
        .elements = values_of(derived, study_)};
    variable.attributes.push_back({kFollows, derived.expression});
    variable.is_compressed = derived.axes.size() > 1;
    columns_ += (columns_.empty() ? "" : " ") + name;
    out_.variables.push_back(std::move(variable));
  }

  DataVariable coordinate(const Swept& swept, const std::string& name,
                          const std::string& dimension) const {
    return {.name = name,
            .stored = Stored::real,
            .dimensions = {dimension},
            .attributes = notes_.describe(swept.unit, swept.meaning),
            .elements = std::span(swept.values)};
  }

  void add_spectrum() {
    SpectrumNumbers numbers = numbers_of_spectrum(result_, notes_, map_dimensions_);
    std::ranges::move(numbers.attributes, std::back_inserter(out_.attributes));
    for (DataVariable& map : numbers.maps) {
      add_columns(&map);
      out_.variables.push_back(std::move(map));
    }
  }

  // The names of the columns of axes, as the CF conventions and xarray want them.
  void add_columns(DataVariable* variable) const {
    if (!columns_.empty()) variable->attributes.push_back({"coordinates", columns_});
  }

  void add_status() {
    DataVariable variable = {.name = "status",
                             .stored = Stored::byte,
                             .dimensions = map_dimensions_,
                             .attributes = notes_.describe("", "why the point ended"),
                             .elements = std::span(result_.status),
                             .is_compressed = true};
    std::vector<std::string> names, meanings;
    std::vector<signed char> codes;
    const auto add = [&](const char* name, int code, const char* meaning) {
      names.emplace_back(name);
      codes.push_back(static_cast<signed char>(code));
      meanings.push_back(fmt::format("{}: {}", name, meaning));
    };
#define GEARSWEEP_ADD_STATUS(name, code, meaning) add(#name, code, meaning);
    SWEEP_STATUSES(GEARSWEEP_ADD_STATUS)
#undef GEARSWEEP_ADD_STATUS
    add_flags(codes, names, &variable.attributes);
    variable.attributes.push_back({"comment", fmt::format("{}", fmt::join(meanings, "; "))});
    add_columns(&variable);
    out_.variables.push_back(std::move(variable));
  }

  void add_quantity(const Quantity& quantity, const std::vector<double>& values) {
    const bool is_class = !quantity.flags.empty();
    DataVariable variable = {.name = quantity.name,
                             .stored = is_class ? Stored::byte : stored_real(),
                             .dimensions = map_dimensions_,
                             .attributes = {},
                             .elements = std::span(values),
                             .is_compressed = true};
    if (quantity.width > 1 || quantity.dimension == kOrders) {
      add_numbered(quantity.dimension, quantity.width);
      variable.dimensions.push_back(quantity.dimension);
    }
    variable.attributes = quantity.dimension == kComponents
                              ? notes_.describe(study_.model->states, kComponents, quantity.meaning)
                              : notes_.describe(quantity.unit, quantity.meaning);
    variable.attributes.push_back(fill_of(variable.stored));
    if (is_class) add_flags(quantity.flags, &variable.attributes);
    add_pilot_error(quantity.name, &variable);
    add_columns(&variable);
    out_.variables.push_back(std::move(variable));
  }

  void add_pilot_error(const std::string& quantity, DataVariable* variable) const {
    if (!result_.pilot) return;
    const auto error = result_.pilot->errors.find(quantity);
    if (error == result_.pilot->errors.end()) return;
    variable->attributes.push_back({"pilot_error", error->second});
  }

  // The dimension of this name with the coordinate 1, 2, ..., unless it is there already.
  void add_numbered(const std::string& name, std::size_t size) {
    const bool is_known =
        std::any_of(out_.variables.begin(), out_.variables.end(),
                    [&](const DataVariable& known) { return known.name == name; });
    if (is_known) return;
    if (name == kOrders) {
      add_orders();
      return;
    }
    const std::string what = name == kAttractorNumber      ? "attractor"
                             : name == kUncertainDimension ? "uncertain parameter"
                                                           : name;
    add_count(name, size, fmt::format("number of the {}", what));
    if (name == kUncertainDimension) {
      std::vector<std::string> names;
      for (const UncertainParameter& parameter : study_.uncertain.parameters) {
        names.push_back(parameter.draws.name);
      }
      add_texts("uncertain_parameter", "name of each uncertain parameter", name, names, &out_);
    }
    if (name != kComponents) return;
    // What the numbers of the model's states stand for.
    const std::vector<ChannelInfo>& states = study_.model->states;
    add_texts(kComponents + std::string("_state"), "state of each component", name,
              names_of(states), &out_);
    notes_.add_channels(states, kComponents, name, &out_);
  }

  // What the uncertain parameters are in each draw; the values of quantities stand along the same
  // dimension.
  void add_draws() {
    const Uncertain& uncertain = study_.uncertain;
    const std::size_t draws = uncertain.independent_draws();
    add_numbered(kUncertainDimension, uncertain.parameters.size());
    add_numbered(kDrawDimension, draws);
    std::vector<ChannelInfo> shown;
    std::vector<double> values;
    for (const UncertainParameter& parameter : uncertain.parameters) {
      const Axis& axis = parameter.draws;
      shown.push_back(parameter.is_factor
                          ? ChannelInfo{axis.name, "1", "factor of the point's own " + axis.name}
                          : ChannelInfo{axis.name, axis.unit, axis.meaning});
    }
    for (std::size_t draw = 0; draw < draws; ++draw) {
      for (const UncertainParameter& parameter : uncertain.parameters) {
        values.push_back(parameter.draws.values[draw]);
      }
    }
    const std::string name = "uncertain_value";
    out_.variables.push_back(
        {.name = name,
         .stored = Stored::real,
         .dimensions = {kDrawDimension, kUncertainDimension},
         .attributes = notes_.describe("", "each uncertain parameter in each draw"),
         .elements = values});
    notes_.add_channels(shown, name, kUncertainDimension, &out_);
  }

  void add_orders() {
    const std::vector<double>& orders = study_.selection.orders;
    out_.dimensions.push_back({kOrders, orders.size()});
    out_.variables.push_back({.name = kOrders,
                              .stored = Stored::real,
                              .dimensions = {kOrders},
                              .attributes = notes_.describe("1", "multiple of the mesh frequency"),
                              .elements = std::span(orders)});
  }

  void add_count(const std::string& name, std::size_t size, const std::string& meaning) {
    out_.dimensions.push_back({name, size});
    out_.variables.push_back({.name = name,
                              .stored = Stored::integer,
                              .dimensions = {name},
                              .attributes = notes_.describe("", meaning),
                              .elements = numbers_to(size)});
  }

  void add_poincare() {
    const std::size_t record = study_.integrate.record;
    const std::vector<ChannelInfo> states = chosen_states();
    out_.dimensions.push_back({"state", states.size()});
    add_texts("state", "state that was sampled", "state", names_of(states), &out_);
    notes_.add_channels(states, "state", "state", &out_);
    add_count("sample", record, "recorded period");

    const SampleBlock block = block_of_samples(study_);
    DataVariable variable = {.name = "poincare",
                             .stored = stored_real(),
                             .dimensions = map_dimensions_,
                             .attributes = notes_.describe(states, "state", sampled_where()),
                             .elements = std::span(result_.samples),
                             .is_compressed = true,
                             .chunk = {block.rows, block.columns, states.size(), record}};
    if (map_dimensions_.size() == 1) variable.chunk.erase(variable.chunk.begin());
    variable.dimensions.insert(variable.dimensions.end(), {"state", "sample"});
    variable.attributes.push_back(fill_of(variable.stored));
    add_columns(&variable);
    out_.variables.push_back(std::move(variable));
  }

  std::string sampled_where() const {
    const std::string& section = study_.selection.section;
    if (section.empty()) return "states at phase 0 of each recorded period";
    return fmt::format("states at the first returns to section {}", section);
  }

  std::vector<ChannelInfo> chosen_states() const {
    std::vector<ChannelInfo> states;
    for (const std::size_t state : study_.selection.poincare) {
      states.push_back(study_.model->states[state]);
    }
    return states;
  }

  // The fill value, of the variable's own type.
  static Attribute fill_of(Stored stored) {
    constexpr const char* kName = "_FillValue";
    if (stored == Stored::byte) return {kName, std::vector{kNoClass}};
    if (stored == Stored::single) return {kName, std::numeric_limits<float>::quiet_NaN()};
    return {kName, std::numeric_limits<double>::quiet_NaN()};
  }

  Stored stored_real() const { return study_.integrate.fp64 ? Stored::real : Stored::single; }

  const SweepResult& result_;
  const Study& study_;
  const FileNotes notes_;
  std::vector<std::string> map_dimensions_;  // (y, x) or (x)
  std::string columns_;                      // names of the columns of axes
  Dataset out_;
};

}  // namespace

std::size_t Dataset::size_of(const std::string& dimension) const {
  const auto found = std::find_if(dimensions.begin(), dimensions.end(),
                                  [&](const Dimension& own) { return own.name == dimension; });
  if (found == dimensions.end()) {
    throw std::logic_error(fmt::format("there is no dimension '{}'", dimension));
  }
  return found->size;
}

std::vector<std::size_t> Dataset::shape_of(const DataVariable& variable) const {
  std::vector<std::size_t> shape;
  for (const std::string& dimension : variable.dimensions) shape.push_back(size_of(dimension));
  return shape;
}

Dataset dataset_of(const SweepResult& result, const Provenance& provenance) {
  return Description(result).make(provenance);
}

void write_result(const SweepResult& result, const std::string& path,
                  const Provenance& provenance) {
  write_dataset(dataset_of(result, provenance), path);
}

}  // namespace gearsweep
