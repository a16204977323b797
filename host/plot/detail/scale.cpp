#include "plot/detail/scale.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "plot/detail/text.hpp"

namespace gearsweep {

double between(double from, double to, double share, bool is_log) {
  return is_log ? from * std::pow(to / from, share) : from + share * (to - from);
}

std::vector<double> cell_edges(const ResultAxis& axis) {
  std::vector<double> values = axis.values;
  const bool logarithmic = axis.logarithmic;
  const auto transform = [&](double value) { return logarithmic ? std::log10(value) : value; };
  const auto back = [&](double value) { return logarithmic ? std::pow(10.0, value) : value; };
  std::transform(values.begin(), values.end(), values.begin(), transform);
  if (values.size() == 1) {
    const double half = logarithmic ? 0.05 : std::max(0.05 * std::abs(values[0]), 1e-3);
    return {back(values[0] - half), back(values[0] + half)};
  }
  const std::size_t last = values.size() - 1;
  std::vector<double> edges = {back(values[0] - 0.5 * (values[1] - values[0]))};
  for (std::size_t i = 0; i < last; ++i) edges.push_back(back(0.5 * (values[i] + values[i + 1])));
  edges.push_back(back(values[last] + 0.5 * (values[last] - values[last - 1])));
  return edges;
}

std::string layer_line(std::size_t index) {
  return fmt::format("linecolor rgb '{}' dashtype {}", layer_colour(index), layer_dashes(index));
}

std::string ClassScale::palette() const {
  std::vector<std::string> bands;
  for (std::size_t i = 0; i < names.size(); ++i) {
    bands.push_back(fmt::format("{} '{}', {} '{}'", i, colours[i], i + 1, colours[i]));
  }
  return fmt::format(
      "set palette maxcolors {0}\nset palette defined ({1})\nset cbrange [-0.5:{0}-0.5]\n",
      names.size(), fmt::join(bands, ", "));
}

std::string ClassScale::tics(const Page& page, const std::string& axis, bool marks) const {
  std::vector<std::string> tics;
  for (std::size_t i = 0; i < names.size(); ++i) {
    // gnuplot takes the label of a tic for a format of its number.
    std::string name;
    for (const char letter : page.text(names[i])) {
      name += letter == '%' ? "%%" : std::string(1, letter);
    }
    tics.push_back(fmt::format("{} {}", name, i));
  }
  return fmt::format(
      "set {0}range [-0.5:{1}-0.5]\nset {0}tics out nomirror scale {2} offset {3} ({4})\n", axis,
      names.size(), marks ? "tic,tic/2" : "0", tic_offset(axis), fmt::join(tics, ", "));
}

double ClassScale::widest(const Page& page) const {
  double widest = 0.0;
  for (const std::string& name : names) widest = std::max(widest, page.width_of(name));
  return widest;
}

std::optional<ClassScale> class_scale(const ResultMap& map) {
  std::optional<MapClasses> classes = classes_in(map);
  if (!classes) return std::nullopt;
  for (std::string& name : classes->names) name = literal(name);
  return ClassScale{std::move(*classes)};
}

}  // namespace gearsweep
