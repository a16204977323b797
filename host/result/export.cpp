#include "result/export.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <bit>
#include <set>

#include "model/error.hpp"
#include "result/detail/csv_text.hpp"
#include "result/output_file.hpp"
#include "result/result_file.hpp"
#include "result/si_units.hpp"

namespace gearsweep {
namespace {

// Axes and the columns of lists of points: where a point lies.
std::vector<const ResultAxis*> coordinates_of(const ResultMap& map) {
  std::vector<const ResultAxis*> all;
  for (const ResultAxis& axis : map.axes) {
    all.push_back(&axis);
    for (const ResultAxis& column : axis.columns) all.push_back(&column);
  }
  return all;
}

// Their values at a point, x first.
std::vector<double> place_of(const ResultMap& map, std::size_t point) {
  std::vector<double> out;
  for (const ResultAxis& axis : map.axes) {
    const std::size_t place = point % axis.values.size();
    out.push_back(axis.values[place]);
    for (const ResultAxis& column : axis.columns) out.push_back(column.values[place]);
    point /= axis.values.size();
  }
  return out;
}

// Classes have none.
std::string unit_of(const ResultMap& map, std::size_t column) {
  if (!map.flags.empty()) return "";
  return map.parts.empty() ? map.unit : map.parts[column].unit;
}

std::string csv_of(const std::vector<ResultMap>& maps) {
  const ResultMap& first = maps.front();
  CsvText csv;
  for (const ResultAxis* one : coordinates_of(first)) csv.add_name(one->name, one->unit);
  if (first.is_poincare()) csv.add_name("sample");
  for (const ResultMap& map : maps) {
    const std::vector<std::string> names = map.column_names();
    for (std::size_t i = 0; i < names.size(); ++i) csv.add_name(names[i], unit_of(map, i));
  }
  csv.end_row();
  for (std::size_t point = 0; point < first.points(); ++point) {
    const std::vector<double> place = place_of(first, point);
    for (std::size_t sample = 0; sample < first.samples; ++sample) {
      for (const double coordinate : place) csv.add_number(coordinate);
      if (first.is_poincare()) csv.add_number(static_cast<double>(sample + 1));
      for (const ResultMap& map : maps) {
        const std::size_t columns = map.part_count();
        for (std::size_t column = 0; column < columns; ++column) {
          csv.add_number(map.values[(point * columns + column) * map.samples + sample]);
        }
      }
      csv.end_row();
    }
  }
  return csv.text();
}

std::string stem_of(const std::string& quantity) { return quantity.substr(0, quantity.find(':')); }

// A string of Python: another program may have chosen the name.
std::string python_quoted(const std::string& name) {
  std::string quoted = "'";
  for (const char letter : name) {
    if (letter == '\'' || letter == '\\') quoted += '\\';
    quoted += letter;
  }
  return quoted + "'";
}

std::string npy_header(const std::vector<ResultMap>& maps) {
  const char* real = std::endian::native == std::endian::little ? "<f8" : ">f8";
  std::string fields;
  for (const ResultAxis* one : coordinates_of(maps.front())) {
    fields += fmt::format("({}, '{}'), ", python_quoted(one->name), real);
  }
  for (const ResultMap& map : maps) {
    std::string part_shape;
    if (!map.parts.empty()) part_shape = fmt::format(", ({},)", map.parts.size());
    if (map.is_poincare()) part_shape = fmt::format(", ({}, {})", map.parts.size(), map.samples);
    const char* separator = &map == &maps.back() ? "" : ", ";
    fields += fmt::format("({}, '{}'{}){}", python_quoted(stem_of(map.name)), real, part_shape,
                          separator);
  }
  std::string shape;
  const std::vector<ResultAxis>& axes = maps.front().axes;
  for (auto axis = axes.rbegin(); axis != axes.rend(); ++axis) {
    shape += fmt::format("{}, ", axis->values.size());
  }
  return fmt::format("{{'descr': [{}], 'fortran_order': False, 'shape': ({}), }}", fields, shape);
}

void append_bytes(const double* numbers, std::size_t count, std::string* out) {
  out->append(reinterpret_cast<const char*>(numbers), count * sizeof(double));
}

// Format version 1.0 of numpy.lib.format: mark, version, header length, header, records.
std::string npy_of(const std::vector<ResultMap>& maps) {
  constexpr std::size_t kPreamble = 10, kAlignment = 64;
  std::string header = npy_header(maps);
  const std::size_t unpadded = kPreamble + header.size() + 1;
  header.append((kAlignment - unpadded % kAlignment) % kAlignment, ' ');
  header += '\n';
  if (header.size() > 0xffff) {
    throw InputError("the header of a .npy file takes no more fields: export fewer quantities");
  }
  std::string out = "\x93NUMPY";
  out += {'\x01', '\x00', static_cast<char>(header.size() & 0xff),
          static_cast<char>(header.size() >> 8)};
  out += header;
  const ResultMap& first = maps.front();
  const std::size_t coordinates = coordinates_of(first).size();
  std::size_t width = coordinates;
  for (const ResultMap& map : maps) width += map.values.size() / map.points();
  out.reserve(out.size() + first.points() * width * sizeof(double));
  for (std::size_t point = 0; point < first.points(); ++point) {
    append_bytes(place_of(first, point).data(), coordinates, &out);
    for (const ResultMap& map : maps) {
      const std::size_t count = map.values.size() / map.points();
      append_bytes(map.values.data() + point * count, count, &out);
    }
  }
  return out;
}

// Names that give the same fields would hide each other.
void refuse_twice(const std::vector<std::string>& quantities, bool is_csv) {
  std::set<std::string> seen;
  for (const std::string& quantity : quantities) {
    if (!seen.insert(is_csv ? quantity : stem_of(quantity)).second) {
      throw InputError(fmt::format("-q {}: '{}' is listed twice", fmt::join(quantities, ","),
                                   is_csv ? quantity : stem_of(quantity)));
    }
  }
}

bool is_poincare(const std::string& quantity) { return stem_of(quantity) == "poincare"; }

// All but poincare, which has its rows for itself.
std::vector<std::string> all_quantities(const ResultFile& file) {
  std::vector<std::string> all = file.quantities();
  all.erase(std::remove_if(all.begin(), all.end(), is_poincare), all.end());
  return all;
}

}  // namespace

void export_maps(const std::string& result_path, const std::vector<std::string>& quantities,
                 const std::string& out, TableUnits units) {
  const bool is_csv = out.ends_with(".csv");
  if (!is_csv && !out.ends_with(".npy")) {
    throw InputError(fmt::format("cannot export to '{}': its name must end in .csv or .npy", out));
  }
  if (is_csv && quantities.size() > 1 &&
      std::any_of(quantities.begin(), quantities.end(), is_poincare)) {
    throw InputError(
        fmt::format("-q {}: poincare has one row for each sample, the others one for each point; "
                    "export it to a table of its own",
                    fmt::join(quantities, ",")));
  }
  refuse_twice(quantities, is_csv);
  ensure_writable(out);
  const ResultFile file(result_path);
  std::vector<ResultMap> maps;
  for (const std::string& quantity : quantities.empty() ? all_quantities(file) : quantities) {
    maps.push_back(file.read(quantity));
    if (units == TableUnits::model) continue;
    ensure_scales(file.scales(), result_path);
    convert_to_si(file.scales(), &maps.back());
  }
  if (maps.empty()) throw InputError(fmt::format("'{}' has no maps", result_path));
  write_file(out, is_csv ? csv_of(maps) : npy_of(maps));
}

}  // namespace gearsweep
