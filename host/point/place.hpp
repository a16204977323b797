// Where one point of a study or of a map is. All functions throw InputError.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "study/study.hpp"

namespace gearsweep {

// The value of a parameter or of an initial state.
struct NamedValue {
  std::string name;
  double value = 0.0;
};

struct Placed {
  bool is_state = false;  // an initial state, not a parameter
  std::size_t index = 0;
  double value = 0.0;
};

struct Place {
  std::vector<Placed> values;
  // Values of axes that stand for several parameters, by their names: {"point", 3} of a list.
  std::map<std::string, double> named;
  std::string origin;  // what messages call it: "--at"; empty: nothing
};

// "--at: TEXT", or the text alone.
std::string told_of(const std::string& origin, const std::string& text);

std::size_t parameter_index(const Model& model, const std::string& name, const std::string& origin);

void require_in_range(const ParameterInfo& info, double value, const std::string& origin);

// Refuses names that neither the model nor an axis has, and values that they do not allow.
Place find_place(const Study& study, const std::vector<NamedValue>& values,
                 const std::string& origin);

// The value that the study has without the axis: of a parameter, or of a key of [gear]. Nothing of
// an initial state, a list, and a key that the table does not have.
std::optional<double> own_value(const Study& study, const Axis& axis);

// Whether the axis sweeps what the value is of.
bool is_swept(const Axis& axis, const Placed& placed);

// Leaves each axis the one value that the place gives it, and sets the other parameters. A study
// without axes gets one that does not move: what computes wants one.
void place_parameters(const Place& place, Study* study);

// Puts the initial states of the place into the state that the study's policy gives the point.
void place_states(const Place& place, Study* study);

// The points of a study that go on from their neighbours are those of the axis alone that they do
// so along: moves the place to the nearest of them. Other places are taken as they are. Returns
// what a user must be told; empty: nothing was moved.
std::string move_to_chain(const Study& whole, Place* place);

// The point of the study's axes that is nearest to the place, as --at takes it: "omega=0.8,b=1";
// empty where the place is such a point.
std::string nearest_point(const Study& whole, const Place& place);

// "omega=0.7, b=1"; "point=3"
std::string label_of(const Model& model, const Place& place);

}  // namespace gearsweep
