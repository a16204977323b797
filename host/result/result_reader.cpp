#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <numeric>
#include <system_error>

#include "model/error.hpp"
#include "model/names.hpp"
#include "model/observable.hpp"
#include "result/dataset.hpp"
#include "result/detail/derived_coordinates.hpp"
#include "result/detail/netcdf_file.hpp"
#include "result/order_dataset.hpp"
#include "result/result_file.hpp"
#include "result/si_units.hpp"
#include "result/trace_file.hpp"
#include "study/study_keys.hpp"

namespace gearsweep {
namespace {

constexpr std::size_t kMaxParts = 1000;  // beside each other; a model has far fewer states
// Marks of the classic formats and of HDF5.
constexpr std::string_view kClassicMark = "CDF";
constexpr std::string_view kHdf5Mark = "\x89HDF\r\n\x1a\n";

[[noreturn]] void refuse_foreign(const std::string& path, const std::string& lacks) {
  if (is_trace_file(path)) {
    throw InputError(fmt::format(
        "'{}' holds traces, not maps: 'gearsweep plot' draws it, and 'gearsweep trace -o OUT.csv' "
        "writes a table; give a result of 'gearsweep run'",
        path));
  }
  if (is_order_file(path)) {
    throw InputError(fmt::format(
        "'{}' holds an order map: 'gearsweep plot' draws it, and 'gearsweep orders -o OUT.csv' "
        "writes a table; give a result of 'gearsweep run'",
        path));
  }
  throw InputError(
      fmt::format("'{}' is a NetCDF file that gearsweep did not write: it has no {}; "
                  "give a result of 'gearsweep run'",
                  path, lacks));
}

std::string text_or_empty(const NetcdfFile& file, int variable, const std::string& attribute) {
  return file.text_attribute(variable, attribute).value_or("");
}

std::vector<double> read_row(const NetcdfFile& file, int variable) {
  return file.read(variable, {0}, {file.dimension_size(file.dimensions_of(variable).front())});
}

bool are_finite(const std::vector<double>& values) {
  return std::ranges::all_of(values, [](double value) { return std::isfinite(value); });
}

// The columns of an axis: of a list of points, for example, and parameters derived from it.
std::vector<ResultAxis> read_columns(const NetcdfFile& file, int dimension) {
  std::vector<ResultAxis> columns;
  for (const std::string& name : file.variables()) {
    const int variable = file.find_variable(name);
    if (!file.text_attribute(variable, kSweeps) && !file.text_attribute(variable, kFollows)) {
      continue;
    }
    if (file.dimensions_of(variable) != std::vector<int>{dimension}) continue;
    columns.push_back({.name = name,
                       .unit = text_or_empty(file, variable, "units"),
                       .meaning = text_or_empty(file, variable, "long_name"),
                       .values = read_row(file, variable)});
  }
  return columns;
}

ResultAxis read_axis(const NetcdfFile& file, int dimension) {
  ResultAxis axis;
  axis.name = file.dimension_name(dimension);
  const int variable = file.find_variable(axis.name);
  if (variable < 0 || file.dimensions_of(variable) != std::vector<int>{dimension}) {
    refuse_foreign(file.name(), fmt::format("values of the axis '{}'", axis.name));
  }
  axis.unit = text_or_empty(file, variable, "units");
  axis.meaning = text_or_empty(file, variable, "long_name");
  axis.logarithmic = text_or_empty(file, variable, "scale") == "log";
  axis.values = read_row(file, variable);
  axis.columns = read_columns(file, dimension);
  const auto falling =
      std::adjacent_find(axis.values.begin(), axis.values.end(), std::greater_equal<>());
  if (axis.values.empty() || !are_finite(axis.values) || falling != axis.values.end()) {
    refuse_foreign(file.name(), fmt::format("increasing values of the axis '{}'", axis.name));
  }
  return axis;
}

// Class names by value; empty when the variable is not a class.
std::vector<std::string> read_flags(const NetcdfFile& file, int variable) {
  constexpr double kMaxClass = std::numeric_limits<signed char>::max();
  const std::vector<double> values = file.number_attribute(variable, "flag_values");
  const std::vector<std::string> names =
      split_words(text_or_empty(file, variable, "flag_meanings"));
  std::vector<std::string> flags;
  for (std::size_t i = 0; i < std::min(values.size(), names.size()); ++i) {
    if (!(values[i] >= 0.0 && values[i] <= kMaxClass)) continue;
    const auto value = static_cast<std::size_t>(values[i]);
    if (value >= flags.size()) flags.resize(value + 1);
    flags[value] = names[i];
  }
  return flags;
}

// Whether a variable is a map: over the axes, and beyond them over nothing, over states and their
// samples, or over parts.
bool is_map(const NetcdfFile& file, int variable, const std::vector<int>& axes) {
  const std::vector<int> own = file.dimensions_of(variable);
  if (own.size() < axes.size() || !std::equal(axes.begin(), axes.end(), own.begin())) return false;
  if (own.size() == axes.size()) return true;
  const std::size_t parts = file.dimension_size(own[axes.size()]);
  if (parts == 0 || parts > kMaxParts || file.dimension_size(own.back()) == 0) return false;
  const bool is_poincare = file.dimension_name(own[axes.size()]) == "state";
  return own.size() - axes.size() == (is_poincare ? 2 : 1);
}

bool has_several_units(const std::vector<ChannelInfo>& parts) {
  return std::any_of(parts.begin(), parts.end(),
                     [&](const ChannelInfo& part) { return part.unit != parts.front().unit; });
}

void mark_missing(const NetcdfFile& file, int variable, std::vector<double>* values) {
  const std::vector<double> fill = file.number_attribute(variable, "_FillValue");
  if (fill.empty() || std::isnan(fill.front())) return;
  std::replace(values->begin(), values->end(), fill.front(),
               std::numeric_limits<double>::quiet_NaN());
}

}  // namespace

bool is_netcdf(const std::string& path) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return false;
  std::ifstream in(path, std::ios::binary);
  std::string start(kHdf5Mark.size(), '\0');
  in.read(start.data(), static_cast<std::streamsize>(start.size()));
  return start == kHdf5Mark || start.substr(0, kClassicMark.size()) == kClassicMark;
}

std::string read_study_text(const std::string& path) {
  const NetcdfFile file = NetcdfFile::open(path);
  const std::optional<std::string> study = file.text_attribute(NC_GLOBAL, "study");
  if (!study) refuse_foreign(path, "attribute 'study'");
  return *study;
}

PointTable read_point_table(const std::string& path) {
  const NetcdfFile file = NetcdfFile::open(path);
  PointTable points;
  for (const std::string& name : file.variables()) {
    const int variable = file.find_variable(name);
    const std::optional<std::string> sweeps = file.text_attribute(variable, kSweeps);
    const std::vector<int> along = file.dimensions_of(variable);
    if (!sweeps || along.size() != 1 || file.dimension_name(along.front()) != kPointAxis) continue;
    points.names.push_back(*sweeps);
    points.columns.push_back(read_row(file, variable));
    if (points.columns.back().size() != points.points() || !are_finite(points.columns.back())) {
      refuse_foreign(path, fmt::format("number for each point in '{}'", name));
    }
  }
  return points;
}

std::optional<FoundStep> read_pilot_step(const std::string& path) {
  const NetcdfFile file = NetcdfFile::open(path);
  const std::vector<double> step = file.number_attribute(NC_GLOBAL, "pilot_max_step");
  const std::vector<double> parts = file.number_attribute(NC_GLOBAL, "pilot_orbit_steps");
  if (step.empty()) return std::nullopt;
  if (parts.empty()) return FoundStep{step.front()};  // of an older file
  if (!(parts.front() >= 1.0 && parts.front() <= kMaxOrbitSteps &&
        parts.front() == std::floor(parts.front()))) {
    throw InputError(fmt::format(
        "'{}': its attribute pilot_orbit_steps is {}; a whole number from 1 to {} is right", path,
        parts.front(), kMaxOrbitSteps));
  }
  return FoundStep{step.front(), static_cast<std::size_t>(parts.front())};
}

ResultFile::ResultFile(const std::string& path)
    : path_(path), file_(std::make_unique<NetcdfFile>(NetcdfFile::open(path))) {
  const int status = file_->find_variable("status");
  if (status < 0) refuse_foreign(path, "variable 'status'");
  const std::vector<int> dimensions = file_->dimensions_of(status);
  if (dimensions.empty() || dimensions.size() > 2 ||
      (dimensions.size() == 2 && dimensions[0] == dimensions[1])) {
    refuse_foreign(path, "map with 1 or 2 axes");
  }
  for (auto dimension = dimensions.rbegin(); dimension != dimensions.rend(); ++dimension) {
    axes_.push_back(read_axis(*file_, *dimension));
  }
  for (const std::string& name : file_->variables()) {
    const auto has_name = [&](const ResultAxis& axis) { return axis.name == name; };
    const bool is_axis = std::ranges::any_of(axes_, [&](const ResultAxis& axis) {
      return has_name(axis) || std::ranges::any_of(axis.columns, has_name);
    });
    if (!is_axis && is_map(*file_, file_->find_variable(name), dimensions)) {
      quantities_.push_back(name);
    }
  }
}

ResultFile::~ResultFile() = default;

std::string ResultFile::title() const { return text_or_empty(*file_, NC_GLOBAL, "title"); }

std::string ResultFile::study_text() const {
  const std::optional<std::string> study = file_->text_attribute(NC_GLOBAL, "study");
  if (!study) refuse_foreign(path_, "attribute 'study'");
  return *study;
}

std::string ResultFile::settings_text() const {
  return text_or_empty(*file_, NC_GLOBAL, "settings");
}

Scales ResultFile::scales() const { return read_scales(*file_); }

std::vector<std::string> ResultFile::poincare_states() const { return names_of(read_states()); }

std::vector<ChannelInfo> ResultFile::read_states() const {
  std::vector<ChannelInfo> states;
  if (file_->find_variable("poincare") < 0) return states;
  const auto texts = [&](const char* name) {
    const int variable = file_->find_variable(name);
    if (variable < 0) refuse_foreign(path_, fmt::format("variable '{}'", name));
    return file_->read_texts(variable);
  };
  const std::vector<std::string> names = texts("state");
  const std::vector<std::string> units = texts("state_units");
  const std::vector<std::string> meanings = texts("state_long_name");
  if (names.empty() || units.size() != names.size() || meanings.size() != names.size()) {
    refuse_foreign(path_, "unit and meaning for each state");
  }
  for (std::size_t i = 0; i < names.size(); ++i) {
    states.push_back({names[i], units[i], meanings[i]});
  }
  return states;
}

// Orders are called by their values, which need not be whole; other parts by their numbers.
std::vector<std::string> ResultFile::read_part_names(int dimension) const {
  const std::size_t count = file_->dimension_size(dimension);
  std::vector<double> values(count);
  std::iota(values.begin(), values.end(), 1.0);
  const int orders = file_->find_variable(kOrders);
  if (file_->dimension_name(dimension) == kOrders && orders >= 0 &&
      file_->dimensions_of(orders) == std::vector<int>{dimension}) {
    values = file_->read(orders, {0}, {count});
  }
  std::vector<std::string> names;
  for (const double value : values) names.push_back(fmt::format("{}", value));
  return names;
}

// What stands beside each other at a point of a variable: states, or numbered parts.
std::vector<ChannelInfo> ResultFile::read_parts(int variable) const {
  const std::vector<int> dimensions = file_->dimensions_of(variable);
  if (dimensions.size() == axes_.size()) return {};
  const int dimension = dimensions[axes_.size()];
  const std::string along = file_->dimension_name(dimension);
  std::vector<ChannelInfo> parts;
  if (along == "state") {
    parts = read_states();
    if (parts.size() != file_->dimension_size(dimension)) {
      refuse_foreign(path_, "name for each state");
    }
    return parts;
  }
  const std::size_t count = file_->dimension_size(dimension);
  std::vector<std::string> units(count, text_or_empty(*file_, variable, "units"));
  if (const int list = file_->find_variable(fmt::format("{}_units", along)); list >= 0) {
    units = file_->read_texts(list);
    if (units.size() != count) refuse_foreign(path_, fmt::format("unit for each {}", along));
  }
  const std::string meaning = text_or_empty(*file_, variable, "long_name");
  const std::vector<std::string> names = read_part_names(dimension);
  for (std::size_t i = 0; i < count; ++i) {
    parts.push_back({names[i], units[i], fmt::format("{}, {} {}", meaning, along, names[i])});
  }
  return parts;
}

Cut ResultFile::find_cut(const std::string& axis, double value) const {
  std::vector<std::string> known;
  for (const ResultAxis& candidate : axes_) known.push_back(candidate.name);
  const auto found = std::find(known.begin(), known.end(), axis);
  if (found == known.end()) {
    throw InputError(
        fmt::format("'{}' has no axis '{}'{}", path_, axis, suggest_name(axis, known)));
  }
  Cut cut;
  cut.axis = static_cast<std::size_t>(found - known.begin());
  const std::vector<double>& values = axes_[cut.axis].values;
  const auto [min, max] = std::minmax_element(values.begin(), values.end());
  // Half a mean step beyond the ends is still nearest to a point of the grid.
  const double reach =
      0.5 * (*max - *min) / static_cast<double>(std::max<std::size_t>(1, values.size() - 1)) +
      1e-9 * std::max(std::abs(*min), std::abs(*max));
  if (!(value >= *min - reach && value <= *max + reach)) {
    throw InputError(
        fmt::format("{} = {} is outside the axis '{}' of '{}', which goes from {} to {}", axis,
                    value, axis, path_, *min, *max));
  }
  const auto nearest = std::min_element(values.begin(), values.end(), [&](double a, double b) {
    return std::abs(a - value) < std::abs(b - value);
  });
  cut.index = static_cast<std::size_t>(nearest - values.begin());
  return cut;
}

void ResultFile::refuse_unknown(const std::string& quantity) const {
  std::vector<std::string> known = quantities_;
  for (const std::string& name : quantities_) {
    for (const ChannelInfo& part : read_parts(file_->find_variable(name))) {
      known.push_back(fmt::format("{}:{}", name, part.name));
    }
  }
  throw InputError(
      fmt::format("'{}' has no quantity '{}'{}", path_, quantity, suggest_name(quantity, known)));
}

ResultMap ResultFile::read(const std::string& quantity, const std::optional<Cut>& cut) const {
  const std::size_t colon = quantity.find(':');
  const std::string name = quantity.substr(0, colon);
  if (std::find(quantities_.begin(), quantities_.end(), name) == quantities_.end()) {
    refuse_unknown(quantity);
  }
  const int variable = file_->find_variable(name);
  ResultMap map;
  map.name = quantity;
  map.unit = text_or_empty(*file_, variable, "units");
  map.meaning = text_or_empty(*file_, variable, "long_name");
  map.flags = read_flags(*file_, variable);
  map.axes = axes_;

  // A block of the file: all of it, less a cut and the parts that are not asked for.
  std::vector<std::size_t> start, count;
  const std::vector<int> dimensions = file_->dimensions_of(variable);
  for (const int dimension : dimensions) {
    start.push_back(0);
    count.push_back(file_->dimension_size(dimension));
  }
  if (cut) {
    const std::size_t dimension = axes_.size() - 1 - cut->axis;
    start[dimension] = cut->index;
    count[dimension] = 1;
    map.axes.erase(map.axes.begin() + static_cast<std::ptrdiff_t>(cut->axis));
  }
  map.parts = read_parts(variable);
  if (!map.parts.empty()) map.dimension = file_->dimension_name(dimensions[axes_.size()]);
  if (map.is_poincare()) {
    map.samples = count.back();
  } else if (has_several_units(map.parts)) {
    map.unit = std::string("1");
  }
  if (colon != std::string::npos) {
    const std::string wanted = quantity.substr(colon + 1);
    const auto part = std::find_if(map.parts.begin(), map.parts.end(),
                                   [&](const ChannelInfo& info) { return info.name == wanted; });
    if (part == map.parts.end()) refuse_unknown(quantity);
    start[axes_.size()] = static_cast<std::size_t>(part - map.parts.begin());
    count[axes_.size()] = 1;
    map.parts = {ChannelInfo(*part)};
    map.unit = map.parts.front().unit;
    if (!map.is_poincare()) map.meaning = map.parts.front().meaning;
  }
  map.values = file_->read(variable, start, count);
  mark_missing(*file_, variable, &map.values);
  return map;
}

}  // namespace gearsweep
