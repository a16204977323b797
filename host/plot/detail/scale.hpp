// Where the cells of a map lie and what colours they have.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "plot/classes.hpp"
#include "plot/colours.hpp"
#include "plot/detail/page.hpp"
#include "plot/value_range.hpp"
#include "result/result_file.hpp"

namespace gearsweep {

// The place on a scale at this share of the way; ends of a logarithmic one are above zero.
double between(double from, double to, double share, bool is_log);

// Edges of the cells around the values of an axis, which go upwards: one more than values.
std::vector<double> cell_edges(const ResultAxis& axis);

// One of several curves that lie over one another, as "plot" takes its colour and dashes.
std::string layer_line(std::size_t index);

// The same with names as markup, and as gnuplot takes them.
struct ClassScale : MapClasses {
  // A "set palette" line of one colour per class, and "set cbrange".
  std::string palette() const;
  // "set" lines of tics with the classes' names at an axis "y" or "y2", whose range they set.
  std::string tics(const Page& page, const std::string& axis, bool marks) const;
  double widest(const Page& page) const;  // name, in points
};

// The scale of what classes_in() finds.
std::optional<ClassScale> class_scale(const ResultMap& map);

}  // namespace gearsweep
