// Small gear units in REXS.
#pragma once

#include <string>

namespace gearsweep::testing {

// Two stages, 20/40 teeth of module 3 mm and 25/50 of module 0.005 m. Lengths of the middle shaft
// are in m, its density in kg/m^3, torque in N mm.
inline std::string two_stage_xml() {
  const auto component = [](const char* id, const char* type, const std::string& attributes) {
    return std::string("<component id=\"") + id + "\" type=\"" + type + "\" name=\"" + type + id +
           "\">" + attributes + "</component>\n";
  };
  const auto value = [](const char* name, const char* unit, const char* text) {
    return std::string("<attribute id=\"") + name + "\" unit=\"" + unit + "\">" + text +
           "</attribute>";
  };
  const auto relation = [](const char* type, const char* first, const char* role,
                           const char* second, const char* other) {
    return std::string("<relation id=\"1\" type=\"") + type + "\"><ref id=\"" + first +
           "\" role=\"" + role + "\"/><ref id=\"" + second + "\" role=\"" + other +
           "\"/></relation>";
  };
  const auto gear = [&](const char* id, const char* teeth, const char* unit, const char* module) {
    return component(id, "cylindrical_gear",
                     value("number_of_teeth", "", teeth) + value("normal_module", unit, module) +
                         value("face_width", "mm", "30") +
                         value("u_coordinate_on_shaft", "mm", "500") +
                         value("helix_angle_reference_diameter", "rad", "0") +
                         value("normal_pressure_angle", "deg", "20"));
  };
  const auto stage = [](const char* id, const char* first, const char* second) {
    return std::string("<relation id=\"2\" type=\"stage\"><ref id=\"") + id +
           "\" role=\"stage\"/><ref id=\"" + first + "\" role=\"gear_1\"/><ref id=\"" + second +
           "\" role=\"gear_2\"/></relation>";
  };
  return "<?xml version=\"1.0\"?>\n<model version=\"1.3\" applicationId=\"a test\">\n<relations>" +
         relation("assembly", "1", "assembly", "11", "part") +
         relation("assembly", "2", "assembly", "12", "part") +
         relation("assembly", "2", "assembly", "13", "part") +
         relation("assembly", "3", "assembly", "14", "part") +
         relation("assembly", "2", "assembly", "31", "part") +
         relation("assembly", "2", "assembly", "32", "part") +
         relation("assembly", "1", "assembly", "41", "part") +
         relation("assembly", "3", "assembly", "42", "part") +
         relation("reference", "2", "origin", "51", "referenced") + stage("21", "11", "12") +
         stage("22", "13", "14") + "</relations>\n<components>\n" +
         component("1", "shaft", value("rotational_speed", "1 / s", "10")) +
         component("2", "shaft", "") + component("3", "shaft", "") + gear("11", "20", "mm", "3") +
         gear("12", "40", "mm", "3") + gear("13", "25", "m", "0.005") +
         gear("14", "50", "mm", "5") +
         component("21", "cylindrical_stage", value("center_distance", "cm", "9.2")) +
         component("22", "cylindrical_stage", value("center_distance", "mm", "187.5")) +
         component("31", "shaft_section",
                   value("length", "m", "0.1") + value("outer_diameter_begin", "mm", "40")) +
         component("32", "shaft_section",
                   value("length", "mm", "50") + value("outer_diameter_begin", "mm", "40") +
                       value("outer_diameter_end", "mm", "20") +
                       value("inner_diameter_begin", "mm", "10")) +
         component("41", "external_load", value("torque_around_u_axis", "N mm", "60000")) +
         component("42", "external_load", value("transmits_torque", "", "true")) +
         component("51", "material", value("density", "kg / m^3", "7000")) +
         "</components>\n</model>\n";
}

// A sun of 18 teeth between three planets of 20 and a ring of 58, held by the casing.
inline std::string planetary_json() {
  std::string text =
      R"({"model": {"version": "1.6", "applicationId": "a test", "relations": [)"
      R"({"id": 1, "type": "assembly", "refs": [{"id": 1, "role": "assembly"}, {"id": 10, "role": "part"}]},)"
      R"({"id": 2, "type": "assembly", "refs": [{"id": 2, "role": "assembly"}, {"id": 30, "role": "part"}]},)"
      R"({"id": 3, "type": "side", "refs": [{"id": 4, "role": "assembly"}, {"id": 2, "role": "inner_part"}, {"id": 5, "role": "outer_part"}]},)"
      R"({"id": 4, "type": "assembly", "refs": [{"id": 1, "role": "assembly"}, {"id": 6, "role": "part"}]})";
  const auto stage = [&](int id, int first, int second) {
    const std::string s = std::to_string(id);
    text += R"(,{"id": 9, "type": "stage", "refs": [{"id": )" + s +
            R"(, "role": "stage"}, {"id": )" + std::to_string(first) +
            R"(, "role": "gear_1"}, {"id": )" + std::to_string(second) +
            R"(, "role": "gear_2"}]},{"id": 9, "type": "assembly", "refs": [{"id": 7, "role": )" +
            R"("assembly"}, {"id": )" + s + R"(, "role": "part"}]})";
  };
  for (int i = 0; i < 3; ++i) {
    stage(50 + i, 10, 20 + i);
    stage(60 + i, 20 + i, 30);
  }
  text +=
      R"(], "components": [{"id": 1, "type": "shaft", "name": "sun", "attributes": [{"id": "rotational_speed", "unit": "1 / min", "floating_point": 1520.0}]},)"
      R"({"id": 2, "type": "shaft", "name": "ring"}, {"id": 4, "type": "coupling"}, {"id": 5, "type": "gear_casing"},)"
      R"({"id": 7, "type": "planetary_stage", "attributes": [{"id": "x", "floating_point_array_coded": {"code": "float32", "value": "MveeQZ6hM0I"}}]},)"
      R"({"id": 6, "type": "external_load", "attributes": [{"id": "torque_around_u_axis", "unit": "N m", "floating_point": 90.0}]})";
  const auto gear = [&](int id, const char* type, int teeth) {
    text += R"(,{"id": )" + std::to_string(id) + R"(, "type": ")" + type +
            R"(", "attributes": [{"id": "number_of_teeth", "integer": )" + std::to_string(teeth) +
            R"(}, {"id": "normal_module", "unit": "mm", "floating_point": 2.0}]})";
  };
  gear(10, "cylindrical_gear", 18);
  gear(30, "ring_gear", 58);
  for (int i = 0; i < 3; ++i) {
    gear(20 + i, "cylindrical_gear", 20);
    for (const int stage_id : {50 + i, 60 + i}) {
      text += R"(,{"id": )" + std::to_string(stage_id) + R"(, "type": "cylindrical_stage"})";
    }
  }
  return text + "]}}";
}

}  // namespace gearsweep::testing
