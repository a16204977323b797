// A list of points: the parameters and initial states of each, in columns.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace gearsweep {

struct PointTable {
  std::vector<std::string> names;            // of parameters and states, distinct
  std::vector<std::vector<double>> columns;  // [name][point], finite

  bool empty() const { return names.empty(); }
  std::size_t points() const { return columns.empty() ? 0 : columns.front().size(); }
};

// text: a line of names, then a line for each point, with a comma, a semicolon or white space
// between the columns. '#' begins a comment. Throws InputError "source:line: message".
PointTable parse_points(std::string_view text, const std::string& source);

// The same from names and the lines of the points alone.
PointTable parse_points(const std::vector<std::string>& names, std::string_view lines,
                        const std::string& source);

// The lines of the points, from which parse_points() reads the same numbers bit by bit.
std::string lines_of(const PointTable& points);

// Reads the file at `path`. Throws InputError.
PointTable read_points(const std::string& path);

}  // namespace gearsweep
