// Drawings of two gear pairs as tables of numbers, and what follows from them for gear5.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "gear/conversion.hpp"
#include "study/builtin_models.hpp"

namespace gearsweep::testing {

// Numbers by the names of keys.
using Table = std::map<std::string_view, std::vector<double>>;

// The paper's Table 1 with the mesh stiffness that the model's description chooses.
inline Table table_1() {
  return {{kTeeth.name, {40, 40}},           {kModule.name, {3}},
          {kInertia.name, {2230}},           {kMass.name, {1.0}},
          {kBearingStiffness.name, {3.0e5}}, {kBearingDamping.name, {1.4}},
          {kMeshDamping.name, {0.7}},        {kHalfBacklash.name, {0.05}},
          {kMeshStiffness.name, {2.174e8}},  {kTorque.name, {61}},
          {kTransmissionError.name, {10}}};
}

inline Table unequal_pair() {
  return {{kTeeth.name, {20, 40}},
          {kModule.name, {4.0}},
          {kAddendum.name, {4.5, 3.5}},
          {kInertia.name, {600, 9000}},
          {kMass.name, {0.9, 3.2}},
          {kBearingStiffness.name, {1e5, 2e5, 3e5, 4e5}},
          {kBearingDamping.name, {1.0, 2.0, 3.0, 4.0}},
          {kMeshDamping.name, {0.5}},
          {kHalfBacklash.name, {0.04}},
          {kFaceWidth.name, {25}},
          {kTorque.name, {150}},
          {kTransmissionError.name, {6}},
          {kSpeed.name, {3000}}};
}

inline Table with(Table table, const GearKey& key, const std::vector<double>& values) {
  table[key.name] = values;
  return table;
}

inline Table without(Table table, const GearKey& key) {
  table.erase(key.name);
  return table;
}

inline GearDrawing drawing_of(const Table& table) {
  GearDrawing drawing("[gear]");
  for (const GearKey& key : kGearKeys) {
    const auto given = table.find(key.name);
    if (given == table.end()) continue;
    if (given->second.size() == 1) {
      drawing.set_number(key, given->second.front());
    } else {
      drawing.set_numbers(key, given->second);
    }
  }
  return drawing;
}

// words: of keys that take one, "body": "solid".
inline GearConversion convert(const Table& table,
                              const std::map<std::string_view, std::string>& words = {}) {
  GearDrawing drawing = drawing_of(table);
  for (const GearKey& key : kGearKeys) {
    if (words.contains(key.name)) drawing.set_word(key, words.at(key.name));
  }
  return convert_gear(drawing, *find_model("gear5"));
}

// "key: message"
inline std::string message_of(const Table& table,
                              const std::map<std::string_view, std::string>& words = {}) {
  try {
    convert(table, words);
  } catch (const DrawingError& error) {
    return std::string(error.key()) + ": " + error.what();
  }
  return "accepted";
}

inline bool has(const GearConversion& gear, const std::string& name) {
  return std::any_of(gear.parameters.begin(), gear.parameters.end(),
                     [&](const GearParameter& parameter) { return parameter.name == name; });
}

inline GearParameter parameter_of(const GearConversion& gear, const std::string& name) {
  for (const GearParameter& parameter : gear.parameters) {
    if (parameter.name == name) return parameter;
  }
  ADD_FAILURE() << "no parameter " << name;
  return {};
}

inline double value_of(const GearConversion& gear, const std::string& name) {
  return parameter_of(gear, name).value;
}

inline std::string notes_of(const GearConversion& gear) {
  std::string all;
  for (const std::string& note : gear.notes) all += note + "\n";
  return all;
}

// A dozen operations in double precision, each wrong by 1.1e-16 at most.
inline constexpr double kRounding = 1e-14;

inline void expect_value(const GearConversion& gear, const std::string& name, double expected) {
  EXPECT_NEAR(value_of(gear, name), expected, kRounding * std::fabs(expected)) << name;
}

}  // namespace gearsweep::testing
