// The classes of a map: their names and colours.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "result/result_file.hpp"

namespace gearsweep {

// The classes of a map, each with its name and its colour ("#0072b2"); `values` are what the map
// holds for them, NaN stands for all others.
struct MapClasses {
  std::vector<double> values;
  std::vector<std::string> names, colours;

  // The map's value as an index into the classes; NaN stays NaN, and so does a value of no class.
  double index_of(double value) const;
};

// Classes with names, of those that the map holds; or the few whole numbers (such as periods) that
// are all a map holds, or nearly all: those beyond 8 are then one class. Zero, which stands for
// none, comes last and without a colour.
std::optional<MapClasses> classes_in(const ResultMap& map);

// Values of classes that tell apart what a map of periods or attractors does not: with the kind of
// motion, points without a period are chaotic, quasi-periodic or undecided; with the contact class,
// attractors have impacts or not. Either may be missing.
void tell_classes_apart(const ResultMap* motion, const ResultMap* contact, ResultMap* map);

}  // namespace gearsweep
