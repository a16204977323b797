#include "io/export.hpp"

#include <fmt/format.h>

#include <bit>
#include <cmath>

#include "io/csv_text.hpp"
#include "io/output_file.hpp"
#include "io/result_file.hpp"
#include "model/error.hpp"

namespace gearsweep {
namespace {

// The axes' values at a point, x first.
std::vector<double> coordinates(const ResultMap& map, std::size_t point) {
  std::vector<double> out;
  for (const ResultAxis& axis : map.axes) {
    out.push_back(axis.values[point % axis.values.size()]);
    point /= axis.values.size();
  }
  return out;
}

std::string csv_of(const ResultMap& map) {
  CsvText csv;
  for (const ResultAxis& axis : map.axes) csv.add_name(axis.name);
  const std::size_t columns = map.part_count();
  if (map.is_poincare()) csv.add_name("sample");
  for (const std::string& name : map.column_names()) csv.add_name(name);
  csv.end_row();
  for (std::size_t point = 0; point < map.points(); ++point) {
    const std::vector<double> place = coordinates(map, point);
    for (std::size_t sample = 0; sample < map.samples; ++sample) {
      for (const double coordinate : place) csv.add_number(coordinate);
      if (map.is_poincare()) csv.add_number(static_cast<double>(sample + 1));
      for (std::size_t column = 0; column < columns; ++column) {
        csv.add_number(map.values[(point * columns + column) * map.samples + sample]);
      }
      csv.end_row();
    }
  }
  return csv.text();
}

std::string npy_header(const ResultMap& map) {
  const char* real = std::endian::native == std::endian::little ? "<f8" : ">f8";
  std::string fields;
  for (const ResultAxis& axis : map.axes) fields += fmt::format("('{}', '{}'), ", axis.name, real);
  std::string part_shape;
  if (!map.parts.empty()) part_shape = fmt::format(", ({},)", map.parts.size());
  if (map.is_poincare()) part_shape = fmt::format(", ({}, {})", map.parts.size(), map.samples);
  fields += fmt::format("('{}', '{}'{})", map.name.substr(0, map.name.find(':')), real, part_shape);
  std::string shape;
  for (auto axis = map.axes.rbegin(); axis != map.axes.rend(); ++axis) {
    shape += fmt::format("{}, ", axis->values.size());
  }
  return fmt::format("{{'descr': [{}], 'fortran_order': False, 'shape': ({}), }}", fields, shape);
}

void append_bytes(const double* numbers, std::size_t count, std::string* out) {
  out->append(reinterpret_cast<const char*>(numbers), count * sizeof(double));
}

// Format version 1.0 of numpy.lib.format: mark, version, header length, header, records.
std::string npy_of(const ResultMap& map) {
  constexpr std::size_t kPreamble = 10, kAlignment = 64;
  std::string header = npy_header(map);
  const std::size_t unpadded = kPreamble + header.size() + 1;
  header.append((kAlignment - unpadded % kAlignment) % kAlignment, ' ');
  header += '\n';
  std::string out = "\x93NUMPY";
  out += {'\x01', '\x00', static_cast<char>(header.size() & 0xff),
          static_cast<char>(header.size() >> 8)};
  out += header;
  const std::size_t width = map.values.size() / map.points();
  out.reserve(out.size() + map.points() * (width + map.axes.size()) * sizeof(double));
  for (std::size_t point = 0; point < map.points(); ++point) {
    append_bytes(coordinates(map, point).data(), map.axes.size(), &out);
    append_bytes(map.values.data() + point * width, width, &out);
  }
  return out;
}

}  // namespace

void export_map(const std::string& result_path, const std::string& quantity,
                const std::string& out) {
  const bool is_csv = out.ends_with(".csv");
  if (!is_csv && !out.ends_with(".npy")) {
    throw InputError(fmt::format("cannot export to '{}': its name must end in .csv or .npy", out));
  }
  ensure_writable(out);
  const ResultMap map = ResultFile(result_path).read(quantity);
  write_file(out, is_csv ? csv_of(map) : npy_of(map));
}

}  // namespace gearsweep
