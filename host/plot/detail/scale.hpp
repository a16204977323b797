// Where the cells of a map lie and what colours they have.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "plot/detail/page.hpp"
#include "result/result_file.hpp"

namespace gearsweep {

inline constexpr const char* kMissingColour = "#b3b3b3";
inline constexpr const char* kMissingClassColour = "#000000";  // where classes are grey

// The place on a scale at this share of the way; ends of a logarithmic one are above zero.
double between(double from, double to, double share, bool is_log);

// Edges of the cells around the values of an axis, which go upwards: one more than values.
std::vector<double> cell_edges(const ResultAxis& axis);

// Throws InputError when so many curves could not be told apart.
void ensure_tellable(std::size_t layers);
// One of several curves that lie over one another: "#0072b2", its dashes, and both as "plot" takes
// them.
std::string layer_colour(std::size_t index);
std::string layer_dashes(std::size_t index);
std::string layer_line(std::size_t index);

// The classes of a map, each with its colour; `values` are what the map holds for them, NaN stands
// for all others.
struct ClassScale {
  std::vector<double> values;
  std::vector<std::string> names, colours;  // names: markup

  // The map's value as an index into the classes; NaN stays NaN, and so does a value of no class.
  double index_of(double value) const;
  // A "set palette" line of one colour per class, and "set cbrange".
  std::string palette() const;
  // "set" lines of tics with the classes' names at an axis "y" or "y2", whose range they set.
  std::string tics(const Page& page, const std::string& axis, bool marks) const;
  double widest(const Page& page) const;  // name, in points
};

// Classes with names, of those that the map holds; or the few whole numbers (such as periods) that
// are all a map holds, or nearly all: those beyond 8 are then one class. Zero, which stands for
// none, comes last and without a colour.
std::optional<ClassScale> class_scale(const ResultMap& map);

// Values of classes that tell apart what a map of periods or attractors does not: with the kind of
// motion, points without a period are chaotic, quasi-periodic or undecided; with the contact class,
// attractors have impacts or not. Either may be missing.
void tell_classes_apart(const ResultMap* motion, const ResultMap* contact, ResultMap* map);

struct ValueRange {
  double min = 0.0, max = 1.0;
  bool clipped = false;
};

// Ends that were asked for in place of the range's own. Throws InputError when nothing is left
// between them; `option`: its name, for messages.
ValueRange limited(const ValueRange& range, const Limits& limits, const std::string& option);

// The same of the range of `values`, with all ends above zero when it is logarithmic. Throws
// InputError when those that were asked for are not, or no value is.
ValueRange scale_range(const ValueRange& range, const std::vector<double>& values,
                       const Limits& limits, bool is_log, const std::string& option);

// Never empty. Where a few outliers would take all contrast from the rest, it leaves out one value
// in a thousand at either end, and is then `clipped`.
ValueRange colour_range(const std::vector<double>& values);

// Of all values, with a margin, so that nothing touches the frame.
ValueRange padded_range(const std::vector<double>& values);

}  // namespace gearsweep
