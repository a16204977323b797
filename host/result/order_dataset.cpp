#include "result/order_dataset.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "model/error.hpp"
#include "orders/order_map.hpp"
#include "result/detail/csv_text.hpp"
#include "result/detail/dataset_file.hpp"
#include "result/detail/file_notes.hpp"
#include "result/detail/netcdf_file.hpp"
#include "result/detail/universal_file.hpp"
#include "result/output_file.hpp"
#include "result/si_units.hpp"

namespace gearsweep {
namespace {

constexpr const char* kContentOfOrders = "order map of gearsweep";

std::string unit_of_frequency(const Model& model) {
  return time_unit(model) == "1/varpi" ? "varpi" : "1";
}

std::string word_of_order(const Model& model) { return model.contact_force() ? "mesh" : "forcing"; }

// A parameter with the name of something else here gives way.
std::string name_of_axis(const Axis& axis) {
  const std::vector<std::string> own = {"order",        "mode",      "forcing_frequency",
                                        "mean",         "amplitude", "natural_frequency",
                                        "damping_ratio"};
  const bool is_taken = std::find(own.begin(), own.end(), axis.name) != own.end();
  return is_taken ? "parameter_" + axis.name : axis.name;
}

// Puts the dataset together, variable by variable.
class OrderDescription {
 public:
  explicit OrderDescription(const OrderMap& map)
      : map_(map), axis_(name_of_axis(map.axis())), notes_(map.study, {map.axis().name}) {}

  Dataset make(const Provenance& provenance) {
    out_.attributes = {{"content", kContentOfOrders}};
    for (Attribute& own : notes_.provenance(provenance)) out_.attributes.push_back(std::move(own));
    const Model& model = *map_.study.model;
    out_.attributes.push_back({"axis", axis_});
    out_.attributes.push_back({"channel", map_.channel.name});
    out_.attributes.push_back({"order_of", word_of_order(model)});
    out_.attributes.push_back({"window", map_.window == SpectrumWindow::hann ? "hann" : "none"});
    out_.attributes.push_back({"periods", static_cast<double>(map_.study.integrate.record)});
    out_.attributes.push_back({"samples_per_period", static_cast<double>(map_.samples_per_period)});
    std::size_t modes = 0;
    for (const std::vector<NaturalMode>& own : map_.modes) modes = std::max(modes, own.size());
    out_.dimensions = {{axis_, map_.axis().values.size()}, {"order", map_.orders.size()}};
    add(axis_, {axis_}, map_.axis().unit, map_.axis().meaning, map_.axis().values);
    out_.variables.back().attributes.push_back(
        {"scale", map_.axis().logarithmic ? "log" : "linear"});
    add("order", {"order"}, "1", fmt::format("multiples of the {} frequency", word_of_order(model)),
        map_.orders);
    const std::string frequency = unit_of_frequency(model);
    add("forcing_frequency", {axis_}, frequency, "frequency of order 1", map_.forcing);
    add("mean", {axis_}, map_.channel.unit, "mean of " + map_.channel.name, map_.mean);
    add("amplitude", {axis_, "order"}, map_.channel.unit,
        fmt::format("amplitude of {}: {}", map_.channel.name, map_.channel.meaning),
        map_.amplitude);
    out_.variables.back().is_compressed = true;
    if (modes == 0) return std::move(out_);
    out_.dimensions.push_back({"mode", modes});
    add("natural_frequency", {axis_, "mode"}, frequency,
        "natural frequencies about the static equilibrium, with the mean stiffness",
        each_mode(modes, &NaturalMode::frequency));
    add("damping_ratio", {axis_, "mode"}, "1", "share of the critical damping",
        each_mode(modes, &NaturalMode::damping));
    return std::move(out_);
  }

 private:
  void add(const std::string& name, const std::vector<std::string>& dimensions,
           const std::string& unit, const std::string& meaning, std::vector<double> numbers) {
    out_.variables.push_back({.name = name,
                              .stored = Stored::real,
                              .dimensions = dimensions,
                              .attributes = notes_.describe(unit, meaning),
                              .elements = std::move(numbers)});
  }

  // [point][mode]
  std::vector<double> each_mode(std::size_t modes, double NaturalMode::*part) const {
    std::vector<double> numbers;
    for (const std::vector<NaturalMode>& own : map_.modes) {
      for (std::size_t i = 0; i < modes; ++i) {
        numbers.push_back(i < own.size() ? own[i].*part : std::numeric_limits<double>::quiet_NaN());
      }
    }
    return numbers;
  }

  const OrderMap& map_;
  const std::string axis_;
  const FileNotes notes_;
  Dataset out_;
};

// What a table has in place of a unit of the model; without a name where it is 1.
SiUnit unit_in_table(const std::string& unit, const OrderMap& map, TableUnits units) {
  const SiUnit si = units == TableUnits::si ? shown_unit(unit, map.study.scales) : SiUnit{};
  return si.scale > 0.0 ? si : SiUnit{1.0, unit == "1" ? "" : unit};
}

std::string table_of(const OrderMap& map, TableUnits units) {
  const SiUnit axis = unit_in_table(map.axis().unit, map, units);
  const SiUnit channel = unit_in_table(map.channel.unit, map, units);
  const SiUnit frequency = units == TableUnits::si
                               ? SiUnit{hertz_per_unit(map.study.scales), "Hz"}
                               : SiUnit{1.0, unit_of_frequency(*map.study.model)};
  CsvText csv;
  csv.add_name(name_of_axis(map.axis()), axis.name);
  csv.add_name("order");
  csv.add_name("frequency", frequency.name == "1" ? "" : frequency.name);
  csv.add_name("amplitude", channel.name);
  csv.add_name("amplitude_dB");
  csv.end_row();
  const std::size_t orders = map.orders.size();
  for (std::size_t point = 0; point < map.axis().values.size(); ++point) {
    for (std::size_t i = 0; i < orders; ++i) {
      const double amplitude = channel.scale * map.amplitude[point * orders + i];
      csv.add_number(axis.scale * map.axis().values[point]);
      csv.add_number(map.orders[i]);
      csv.add_number(frequency.scale * map.orders[i] * map.forcing[point]);
      csv.add_number(amplitude);
      csv.add_number(amplitude > 0.0 ? decibels(amplitude)
                                     : std::numeric_limits<double>::quiet_NaN());
      csv.end_row();
    }
  }
  return csv.text();
}

// A dataset for each value of the axis, but for those whose motion diverged: there is no spectrum.
std::string universal_file_of(const OrderMap& map, const Provenance& provenance, TableUnits units) {
  const SiUnit axis = unit_in_table(map.axis().unit, map, units);
  const SiUnit channel = unit_in_table(map.channel.unit, map, units);
  const std::size_t orders = map.orders.size();
  std::string text;
  std::vector<double> values(orders);
  std::size_t number = 0;
  for (std::size_t point = 0; point < map.axis().values.size(); ++point) {
    for (std::size_t i = 0; i < orders; ++i) {
      values[i] = channel.scale * map.amplitude[point * orders + i];
    }
    if (!std::ranges::all_of(values, [](double value) { return std::isfinite(value); })) continue;
    const double place = axis.scale * map.axis().values[point];
    const std::string title = fmt::format("{}, amplitude at {} = {:.10g} {}", map.channel.name,
                                          map.axis().name, place, axis.name);
    text += universal_dataset(
        {.title = title,
         .subtitle = "gearsweep " + provenance.version + ": " + map.study.title,
         .first = map.orders.front(),
         .increment = map.orders[1] - map.orders.front(),
         .place = place,
         .abscissa = {kOrderKind, word_of_order(*map.study.model) + " order", ""},
         .ordinate = {kUnknownKind, map.channel.name, channel.name},
         .third = {axis.name == "rpm" ? kRpmKind : kUnknownKind, map.axis().name, axis.name},
         .values = values},
        ++number);
  }
  return text;
}

[[noreturn]] void refuse_no_orders(const std::string& path) {
  throw InputError(
      fmt::format("'{}' holds no order map; give a file that 'gearsweep orders' wrote", path));
}

}  // namespace

double hertz_per_unit(const Scales& scales) { return scales.varpi / (2.0 * std::numbers::pi); }

Dataset dataset_of(const OrderMap& map, const Provenance& provenance) {
  return OrderDescription(map).make(provenance);
}

void ensure_order_file(const std::string& path, const Study& study, TableUnits units) {
  const bool is_known = path.ends_with(".csv") || path.ends_with(".uff") || path.ends_with(".nc");
  if (!is_known) {
    throw InputError(
        fmt::format("cannot write an order map to '{}': its name must end in .nc, .csv or .uff; "
                    "--plot draws one",
                    path));
  }
  if (units == TableUnits::model) return;
  if (!study.scales.known()) {
    throw InputError("--units SI: the study has no [gear] table, which gives the scales");
  }
}

void write_orders(const OrderMap& map, const std::string& path, const Provenance& provenance,
                  TableUnits units) {
  if (path.ends_with(".csv")) {
    write_file(path, table_of(map, units));
  } else if (path.ends_with(".uff")) {
    write_file(path, universal_file_of(map, provenance, units));
  } else {
    write_dataset(dataset_of(map, provenance), path);
  }
}

bool is_order_file(const std::string& path) {
  if (!is_netcdf(path)) return false;
  return NetcdfFile::open(path).text_attribute(NC_GLOBAL, "content") == kContentOfOrders;
}

StoredOrders read_orders(const std::string& path) {
  const NetcdfFile file = NetcdfFile::open(path);
  const auto text = [&](int variable, const std::string& attribute) {
    return file.text_attribute(variable, attribute).value_or("");
  };
  if (text(NC_GLOBAL, "content") != kContentOfOrders) refuse_no_orders(path);
  StoredOrders stored;
  stored.axis.name = text(NC_GLOBAL, "axis");
  const int axis = file.find_variable(stored.axis.name), order = file.find_variable("order");
  const int amplitude = file.find_variable("amplitude");
  const int forcing = file.find_variable("forcing_frequency");
  const int modes = file.find_variable("natural_frequency");
  if (axis < 0 || order < 0 || amplitude < 0 || forcing < 0) refuse_no_orders(path);
  const auto row = [&](int variable) {
    const std::vector<int> dimensions = file.dimensions_of(variable);
    if (dimensions.size() != 1) refuse_no_orders(path);
    return file.read(variable, {0}, {file.dimension_size(dimensions.front())});
  };
  stored.title = text(NC_GLOBAL, "title");
  stored.settings = text(NC_GLOBAL, "settings");
  stored.scales = read_scales(file);
  stored.meshes = read_meshes(file);
  stored.order_of = text(NC_GLOBAL, "order_of");
  stored.channel = {text(NC_GLOBAL, "channel"), text(amplitude, "units"),
                    text(amplitude, "long_name")};
  stored.frequency_unit = text(forcing, "units");
  stored.axis.unit = text(axis, "units");
  stored.axis.meaning = text(axis, "long_name");
  stored.axis.logarithmic = text(axis, "scale") == "log";
  stored.axis.values = row(axis);
  stored.orders = row(order);
  stored.forcing = row(forcing);
  const std::size_t points = stored.axis.values.size(), orders = stored.orders.size();
  stored.amplitude = file.read(amplitude, {0, 0}, {points, orders});
  const auto rises = [](const std::vector<double>& values) {
    return !values.empty() && std::isfinite(values.front()) && std::isfinite(values.back()) &&
           std::adjacent_find(values.begin(), values.end(), std::greater_equal<>()) == values.end();
  };
  const bool is_forced = std::all_of(stored.forcing.begin(), stored.forcing.end(),
                                     [](double f) { return std::isfinite(f) && f > 0.0; });
  if (!rises(stored.axis.values) || !rises(stored.orders) || orders < 2 || !is_forced ||
      stored.forcing.size() != points || stored.channel.name.empty()) {
    refuse_no_orders(path);
  }
  if (modes < 0) return stored;
  const std::vector<int> of_modes = file.dimensions_of(modes);
  if (of_modes.size() != 2) refuse_no_orders(path);
  const std::size_t count = file.dimension_size(of_modes.back());
  const std::vector<double> all = file.read(modes, {0, 0}, {points, count});
  for (std::size_t mode = 0; mode < count; ++mode) {
    stored.frequencies.emplace_back();
    for (std::size_t point = 0; point < points; ++point) {
      stored.frequencies.back().push_back(all[point * count + mode]);
    }
  }
  return stored;
}

}  // namespace gearsweep
