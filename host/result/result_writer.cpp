// Writes a sweep as NetCDF-4, so that xarray, MATLAB, Octave and ncview open it without help.
// The file claims no CF convention: the dimensionless units are not units of UDUNITS.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "result/detail/file_names.hpp"
#include "result/detail/file_notes.hpp"
#include "result/detail/netcdf_file.hpp"
#include "result/result_file.hpp"
#include "result/result_size.hpp"
#include "sweep_types.h"

namespace gearsweep {
namespace {

constexpr signed char kNoClass = -1;
constexpr const char* kComponents = "component";  // the dimension of quantities of every state

std::vector<std::string> names_of_axes(const Study& study) {
  std::vector<std::string> names;
  for (const Axis& axis : study.axes) names.push_back(axis.name);
  return names;
}

// Defines all of the file, then fills it.
class Writer {
 public:
  Writer(const SweepResult& result, NetcdfFile* file)
      : result_(result),
        study_(result.study),
        file_(*file),
        notes_(result.study, names_of_axes(result.study), file) {}

  void write(const Provenance& provenance) {
    write_provenance(provenance);
    for (auto axis = study_.axes.rbegin(); axis != study_.axes.rend(); ++axis) write_axis(*axis);
    write_status();
    for (std::size_t i = 0; i < study_.selection.quantities.size(); ++i) {
      const int variable = write_quantity(study_.selection.quantities[i], result_.values[i]);
      if (result_.pilot) write_pilot_error(variable, study_.selection.quantities[i].name);
    }
    if (study_.selection.census) write_attractors();
    if (!study_.selection.poincare.empty()) write_poincare();
  }

 private:
  void write_provenance(const Provenance& provenance) {
    notes_.put_provenance(provenance);
    const auto put = [&](const char* name, const auto& value) {
      file_.put_attribute(NC_GLOBAL, name, value);
    };
    put("device", result_.engine.device);
    put("driver", result_.engine.driver);
    put("kernel_macros", result_.engine.macros);
    put("integration_steps", result_.steps);
    put("stopped_trajectories", static_cast<double>(result_.stopped));
    put("compute_seconds", result_.seconds);
    put("kernel_seconds", result_.kernel_seconds);
    put("integrated_states", fmt::format("{}", fmt::join(result_.integrated, " ")));
    if (!result_.pilot) return;
    put("pilot_max_step", result_.pilot->step);
    put("pilot_error", result_.pilot->error);
    put("pilot_sensitive", result_.pilot->sensitive);
    put("pilot_points", static_cast<double>(result_.pilot->points));
  }

  void write_axis(const Axis& axis) {
    const std::string name = name_in_result(axis, study_);
    const int dimension = file_.define_dimension(name, axis.values.size());
    map_dimensions_.push_back(dimension);
    const int variable = file_.define_variable(name, NC_DOUBLE, {dimension});
    notes_.describe(variable, axis.unit, axis.meaning);
    file_.put_attribute(variable, "scale", axis.logarithmic ? "log" : "linear");
    put_all(variable, axis.values);
  }

  void write_status() {
    const int variable = file_.define_variable("status", NC_BYTE, map_dimensions_);
    notes_.describe(variable, "", "why the point ended");
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
    put_flags(variable, codes, names);
    file_.put_attribute(variable, "comment", fmt::format("{}", fmt::join(meanings, "; ")));
    file_.compress(variable);
    put_all(variable, std::vector<signed char>(result_.status.begin(), result_.status.end()));
  }

  // Its variable.
  int write_quantity(const Quantity& quantity, const std::vector<double>& values) {
    const bool is_class = !quantity.flags.empty();
    std::vector<int> dimensions = map_dimensions_;
    std::vector<std::size_t> shape = map_shape();
    if (quantity.width > 1) {
      dimensions.push_back(numbered_dimension(quantity.dimension, quantity.width));
      shape.push_back(quantity.width);
    }
    const int variable =
        file_.define_variable(quantity.name, is_class ? NC_BYTE : real_type(), dimensions);
    if (quantity.dimension == kComponents) {
      notes_.describe(variable, study_.model->states, kComponents, quantity.meaning);
    } else {
      notes_.describe(variable, quantity.unit, quantity.meaning);
    }
    set_fill(variable, is_class);
    if (is_class) {
      std::vector<signed char> codes(quantity.flags.size());
      std::iota(codes.begin(), codes.end(), static_cast<signed char>(0));
      put_flags(variable, codes, quantity.flags);
    }
    file_.compress(variable);
    const std::vector<std::size_t> start(shape.size(), 0);
    if (is_class) {
      file_.put(variable, start, shape, classes(values));
    } else {
      put_reals(variable, start, shape, values);
    }
    return variable;
  }

  void write_pilot_error(int variable, const std::string& quantity) {
    const auto error = result_.pilot->errors.find(quantity);
    if (error == result_.pilot->errors.end()) return;
    file_.put_attribute(variable, "pilot_error", error->second);
  }

  // The list that `attractor` numbers, along a dimension of its own.
  void write_attractors() {
    const std::vector<Attractor>& list = result_.attractors;
    const int number = numbered_dimension("attractor_number", list.size());
    const auto write = [&](const std::string& name, const std::string& unit,
                           const std::string& meaning, const auto& value) {
      const int variable = file_.define_variable(name, NC_DOUBLE, {number});
      notes_.describe(variable, unit, meaning);
      std::vector<double> values;
      for (const Attractor& attractor : list) values.push_back(value(attractor));
      put_all(variable, values);
      return variable;
    };
    const ChannelInfo& first = study_.model->states.front();
    const int motion = write("attractor_motion_class", "", "kind of motion of each attractor",
                             [](const Attractor& a) { return static_cast<double>(a.motion); });
    std::vector<signed char> codes(motion_names().size());
    std::iota(codes.begin(), codes.end(), static_cast<signed char>(0));
    put_flags(motion, codes, motion_names());
    write("attractor_period", "1", "period in forcing periods; 0: none",
          [](const Attractor& a) { return a.period; });
    write(fmt::format("attractor_{}_rms", first.name), first.unit,
          fmt::format("root mean square of {}, mean over the attractor's trajectories", first.name),
          [](const Attractor& a) { return a.rms; });
    if (const ChannelInfo* force = study_.model->contact_force()) {
      write(fmt::format("attractor_{}_max", force->name), force->unit,
            "largest dynamic meshing force of the attractor",
            [](const Attractor& a) { return a.peak; });
    }
    write("attractor_lyapunov_max", "1/tau",
          "largest Lyapunov exponent, mean over the attractor's trajectories",
          [](const Attractor& a) { return a.exponent; });
    write("attractor_share", "1", "share of all trajectories that reached the attractor",
          [&](const Attractor& a) {
            return static_cast<double>(a.trajectories) / static_cast<double>(study_.trajectories());
          });
  }

  // The dimension of this name with the coordinate 1, 2, ..., made when it is not there yet.
  int numbered_dimension(const std::string& name, std::size_t size) {
    const int known = file_.find_variable(name);
    if (known >= 0) return file_.dimensions_of(known).front();
    const int dimension = file_.define_dimension(name, size);
    const int variable = file_.define_variable(name, NC_INT, {dimension});
    notes_.describe(
        variable, "",
        fmt::format("number of the {}", name == "attractor_number" ? "attractor" : name));
    std::vector<double> numbers(size);
    std::iota(numbers.begin(), numbers.end(), 1.0);
    put_all(variable, numbers);
    if (name == kComponents) write_components(dimension);
    return dimension;
  }

  // What the numbers of the model's states stand for.
  void write_components(int dimension) {
    const std::vector<ChannelInfo>& states = study_.model->states;
    std::vector<std::string> names;
    for (const ChannelInfo& state : states) names.push_back(state.name);
    notes_.put_texts(kComponents + std::string("_state"), "state of each component", dimension,
                     names);
    notes_.put_channels(states, kComponents, dimension);
  }

  void write_poincare() {
    const std::size_t record = study_.integrate.record;
    const int state = write_states();
    const int sample = file_.define_dimension("sample", record);
    const int sample_variable = file_.define_variable("sample", NC_INT, {sample});
    notes_.describe(sample_variable, "", "recorded period");
    std::vector<double> numbers(record);
    std::iota(numbers.begin(), numbers.end(), 1.0);
    put_all(sample_variable, numbers);

    std::vector<int> dimensions = map_dimensions_;
    dimensions.insert(dimensions.end(), {state, sample});
    const int variable = file_.define_variable("poincare", real_type(), dimensions);
    const std::vector<ChannelInfo> states = chosen_states();
    notes_.describe(variable, states, "state", "states at phase 0 of each recorded period");
    set_fill(variable, false);
    put_samples(variable, states.size() * record);
  }

  void put_samples(int variable, std::size_t per_point) {
    const SampleBlock block = block_of_samples(study_);
    const std::size_t states = study_.selection.poincare.size();
    const bool is_map = map_dimensions_.size() == 2;
    const auto shape_of = [&](std::size_t rows, std::size_t columns) {
      std::vector<std::size_t> shape = {rows, columns, states, per_point / states};
      if (!is_map) shape.erase(shape.begin());
      return shape;
    };
    const std::vector<std::size_t> chunk = shape_of(block.rows, block.columns);
    file_.check(nc_def_var_chunking(file_.id(), variable, NC_CHUNKED, chunk.data()),
                "set the chunks of 'poincare'");
    file_.compress(variable);
    const std::size_t row = study_.axes.front().values.size();
    const std::size_t rows = result_.status.size() / row;
    // Where a block is not a whole row, it has but one.
    for (std::size_t y = 0; y < rows; y += block.rows) {
      for (std::size_t x = 0; x < row; x += block.columns) {
        const std::size_t high = std::min(block.rows, rows - y);
        const std::size_t wide = std::min(block.columns, row - x);
        std::vector<std::size_t> start = {y, x, 0, 0};
        if (!is_map) start.erase(start.begin());
        const auto begin =
            result_.samples.begin() + static_cast<std::ptrdiff_t>((y * row + x) * per_point);
        put_reals(variable, start, shape_of(high, wide),
                  {begin, begin + static_cast<std::ptrdiff_t>(high * wide * per_point)});
      }
    }
  }

  // Returns the dimension.
  int write_states() {
    const std::vector<ChannelInfo> states = chosen_states();
    std::vector<std::string> names;
    for (const ChannelInfo& state : states) names.push_back(state.name);
    const int dimension = file_.define_dimension("state", names.size());
    notes_.put_texts("state", "state that was sampled", dimension, names);
    notes_.put_channels(states, "state", dimension);
    return dimension;
  }

  std::vector<ChannelInfo> chosen_states() const {
    std::vector<ChannelInfo> states;
    for (const std::size_t state : study_.selection.poincare) {
      states.push_back(study_.model->states[state]);
    }
    return states;
  }

  void put_flags(int variable, const std::vector<signed char>& codes,
                 const std::vector<std::string>& names) {
    file_.put_attribute(variable, "flag_values", codes);
    file_.put_attribute(variable, "flag_meanings", fmt::format("{}", fmt::join(names, " ")));
  }

  void set_fill(int variable, bool is_class) {
    const double real = std::numeric_limits<double>::quiet_NaN();
    const float single = std::numeric_limits<float>::quiet_NaN();
    const void* fill = &single;
    if (study_.integrate.fp64) fill = &real;
    if (is_class) fill = &kNoClass;
    file_.check(nc_def_var_fill(file_.id(), variable, NC_FILL, fill), "set a fill value");
  }

  static std::vector<signed char> classes(const std::vector<double>& values) {
    std::vector<signed char> out(values.size(), kNoClass);
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (std::isfinite(values[i])) out[i] = static_cast<signed char>(std::lround(values[i]));
    }
    return out;
  }

  // The library would call it an error when an infinity is to become a float.
  void put_reals(int variable, const std::vector<std::size_t>& start,
                 const std::vector<std::size_t>& shape, const std::vector<double>& values) {
    if (study_.integrate.fp64) return file_.put(variable, start, shape, values);
    std::vector<float> singles(values.size());
    std::transform(values.begin(), values.end(), singles.begin(),
                   [](double value) { return static_cast<float>(value); });
    file_.put(variable, start, shape, singles);
  }

  // The whole of a variable over the map's dimensions, or over its own single one.
  template <typename T>
  void put_all(int variable, const std::vector<T>& values) {
    const bool is_map = file_.dimensions_of(variable) == map_dimensions_;
    const std::vector<std::size_t> shape =
        is_map ? map_shape() : std::vector<std::size_t>{values.size()};
    file_.put(variable, std::vector<std::size_t>(shape.size(), 0), shape, values);
  }

  std::vector<std::size_t> map_shape() const {
    std::vector<std::size_t> shape;
    for (const int dimension : map_dimensions_) shape.push_back(file_.dimension_size(dimension));
    return shape;
  }

  nc_type real_type() const { return study_.integrate.fp64 ? NC_DOUBLE : NC_FLOAT; }

  const SweepResult& result_;
  const Study& study_;
  NetcdfFile& file_;
  FileNotes notes_;
  std::vector<int> map_dimensions_;  // (y, x) or (x)
};

}  // namespace

void write_result(const SweepResult& result, const std::string& path,
                  const Provenance& provenance) {
  OutputFile output(path);
  NetcdfFile file = NetcdfFile::create(output.temporary_path(), path);
  Writer(result, &file).write(provenance);
  file.close();
  output.commit();
}

}  // namespace gearsweep
