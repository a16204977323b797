// Points given on the command line, --at NAME=VALUE,... All throw
// InputError.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "study/study.hpp"

namespace gearsweep {

// A finite number; `option` names what it was given for, in messages.
double to_number(const std::string& text, const std::string& option);

// "name=rest" in two; `example` shows the form.
std::pair<std::string, std::string> split_assignment(const std::string& text,
                                                     const std::string& option,
                                                     const std::string& example);

std::size_t parameter_index(const Model& model, const std::string& name, const std::string& option);

void require_in_range(const ParameterInfo& info, double value, const std::string& option);

// A value of --at.
struct Placed {
  bool is_state = false;  // an initial state, not a parameter
  std::size_t index = 0;
  double value = 0.0;
};

// at: "omega=0.7" each.
std::vector<Placed> read_place(const Model& model, const std::vector<std::string>& at);

// Leaves each axis the one value that --at gives it, and sets the other parameters.
void place_parameters(const std::vector<Placed>& place, Study* study);

// Puts the initial states of --at into the state that the study's policy gives the point.
void place_states(const std::vector<Placed>& place, Study* study);

}  // namespace gearsweep
