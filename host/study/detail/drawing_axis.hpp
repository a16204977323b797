// Axes in the units of a drawing: a key of its table is swept.
#pragma once

#include <toml++/toml.h>

#include <optional>
#include <string>
#include <vector>

#include "study/detail/gear_reader.hpp"
#include "study/study.hpp"

namespace gearsweep {

// A key that an axis can sweep, and the table that it is of.
struct SweptKey {
  const GearKey* key = nullptr;
  DrawingTable from;
  std::optional<std::size_t> member = {};  // of a pair the one that varies, 0 the pinion

  // What the axis is called: torque_N_m, or torque_N_m_first for the drawing `first`.
  std::string name() const { return own_name() + from.suffix; }
  std::string own_name() const {
    return member ? member_name(*key, *member) : std::string(key->name);
  }
};

// All that a study of the model may sweep; a parameter or state of the same name comes first.
// Throws InputError for a [gear] that is none of the model's.
std::vector<SweptKey> swept_keys(const toml::table& study, const Model& model);
// The one of this name, if there is one.
std::optional<SweptKey> find_swept_key(const toml::table& study, const Model& model,
                                       const std::string& name);

// The names of those whose tables the study has.
std::vector<std::string> names_of_keys(const toml::table& study, const Model& model);

// Fills in what is swept from its key, but for the values; the key's range.
std::pair<double, double> bind_key(const GearKey& key, Swept* swept);

// The values of a drawing that the axes of the study give: the first of each.
GearValues first_values(const toml::table& study, const Model& model, const DrawingTable& from,
                        const std::vector<Axis>& axes);

// Joins draws of several keys of one drawing, each of which has its columns: gives each column what
// follows from all keys in each draw, and leaves it to one of those that have it. others, place: as
// below. Throws InputError where one would be left without any.
void join_parameters(const std::vector<std::pair<SweptKey, Axis*>>& keys, const GearValues& others,
                     const Model& model, const toml::node& place);

// Gives the axis, whose values are there, the parameters that follow from each of them as columns.
// others: values of other keys, in place of those of the table. place: what messages point to.
// Throws InputError for what the drawing refuses, and where the units of the result would change
// from value to value.
void add_parameters(const SweptKey& swept, const GearValues& others, const Model& model,
                    const toml::node& place, Axis* axis);

// The same of a list of points whose columns are keys of [gear]: each point has the parameters that
// follow from all of them.
void add_parameters_of_list(const toml::table& study, const std::vector<Axis>& axes,
                            const Model& model, const toml::node& place, Axis* list);

}  // namespace gearsweep
