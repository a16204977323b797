// A number that a model must give, said by others.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace gearsweep {

// Published, or a closed form: no code of this program computed it.
struct KnownAnswer {
  std::string quantity;        // that the model offers
  std::vector<double> values;  // of a quantity that gives several numbers, the first ones
  double tolerance = 0.0;      // absolute, in the quantity's unit
  std::string source;          // who says so, and where the tolerance comes from
  // Where: the preset and the options, as [model] of a study has them, and parameters and states at
  // the start, in the order of the file.
  std::map<std::string, std::string> choices;
  std::vector<std::pair<std::string, double>> at;
  // Keys of [integrate] with their values as TOML.
  std::map<std::string, std::string> integrate;
  // The mean over so many starts: the first state of `at` grows by 0.001 from one to the next.
  std::size_t starts = 1;
};

// "preset ueda, x = 2.5, mean of 64 starts"
std::string describe_place(const KnownAnswer& answer);

}  // namespace gearsweep
