// Gear units in REXS that a test builds, and writes in any of the ways that a maker may.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace gearsweep::testing {

struct TextAttribute {
  std::string id, unit, text;  // "[0, 190, 0]" is a list
};

struct TextComponent {
  std::string id, type, name;
  std::vector<TextAttribute> attributes;

  TextAttribute* find(const std::string& attribute) {
    const auto found = std::ranges::find(attributes, attribute, &TextAttribute::id);
    return found == attributes.end() ? nullptr : &*found;
  }
};

struct TextRelation {
  std::string type;
  std::vector<std::pair<std::string, std::string>> refs;  // role, id
};

struct TextUnit {
  std::string version = "1.4";
  std::vector<TextComponent> components;
  std::vector<TextRelation> relations;

  TextComponent& at(const std::string& id) {
    return *std::ranges::find(components, id, &TextComponent::id);
  }
  void set(const std::string& id, const std::string& attribute, const std::string& unit,
           const std::string& text) {
    if (TextAttribute* found = at(id).find(attribute)) {
      *found = {attribute, unit, text};
    } else {
      at(id).attributes.push_back({attribute, unit, text});
    }
  }
};

// Numbers in a text that is a number or a list of them.
inline std::vector<std::string> cells_of(const std::string& text) {
  std::vector<std::string> cells;
  std::string cell;
  for (const char letter : text) {
    if (letter == '[' || letter == ' ') continue;
    if (letter == ',' || letter == ']') {
      cells.push_back(cell);
      cell.clear();
    } else {
      cell += letter;
    }
  }
  return cells;
}

inline std::string xml_of(const TextUnit& unit) {
  std::string text = fmt::format(
      "<?xml version=\"1.0\"?>\n<model version=\"{}\" applicationId=\"a test\">\n<relations>\n",
      unit.version);
  for (std::size_t i = 0; i < unit.relations.size(); ++i) {
    text += fmt::format("<relation id=\"{}\" type=\"{}\">", i + 1, unit.relations[i].type);
    for (const auto& [role, id] : unit.relations[i].refs) {
      text += fmt::format("<ref id=\"{}\" role=\"{}\"/>", id, role);
    }
    text += "</relation>\n";
  }
  text += "</relations>\n<components>\n";
  for (const TextComponent& one : unit.components) {
    text +=
        fmt::format("<component id=\"{}\" type=\"{}\" name=\"{}\">", one.id, one.type, one.name);
    for (const TextAttribute& attribute : one.attributes) {
      std::string value = attribute.text;
      if (value.starts_with('[')) {
        value = "<array>";
        for (const std::string& cell : cells_of(attribute.text)) value += "<c>" + cell + "</c>";
        value += "</array>";
      }
      text += fmt::format("<attribute id=\"{}\" unit=\"{}\">{}</attribute>", attribute.id,
                          attribute.unit, value);
    }
    text += "</component>\n";
  }
  return text + "</components>\n</model>\n";
}

inline std::string json_of(const TextUnit& unit) {
  const auto joined = [](const std::vector<std::string>& parts) {
    std::string text;
    for (const std::string& part : parts) text += (text.empty() ? "" : ",\n") + part;
    return text;
  };
  std::vector<std::string> relations, components;
  for (const TextRelation& relation : unit.relations) {
    std::vector<std::string> refs;
    for (const auto& [role, id] : relation.refs) {
      refs.push_back(fmt::format(R"({{"id": {}, "role": "{}"}})", id, role));
    }
    relations.push_back(fmt::format(R"({{"id": {}, "type": "{}", "refs": [{}]}})",
                                    relations.size() + 1, relation.type, joined(refs)));
  }
  for (const TextComponent& one : unit.components) {
    std::vector<std::string> attributes;
    for (const TextAttribute& attribute : one.attributes) {
      char* end = nullptr;
      std::strtod(attribute.text.c_str(), &end);
      const bool is_list = attribute.text.starts_with('[');
      const bool is_number = *end == '\0' && !attribute.text.empty();
      attributes.push_back(
          fmt::format(R"({{"id": "{}", "unit": "{}", "{}": {}}})", attribute.id, attribute.unit,
                      is_list     ? "floating_point_array"
                      : is_number ? "floating_point"
                                  : "string",
                      is_list || is_number ? attribute.text : "\"" + attribute.text + "\""));
    }
    components.push_back(
        fmt::format(R"({{"id": {}, "type": "{}", "name": "{}", "attributes": [{}]}})", one.id,
                    one.type, one.name, joined(attributes)));
  }
  return fmt::format(
      R"({{"model": {{"version": "{}", "applicationId": "a test", "relations": [{}], "components": [{}]}}}})",
      unit.version, joined(relations), joined(components));
}

// Components, their attributes, relations and their references in another order.
inline TextUnit shuffled(TextUnit unit, unsigned seed) {
  std::mt19937 random(seed);
  std::ranges::shuffle(unit.components, random);
  std::ranges::shuffle(unit.relations, random);
  for (TextComponent& one : unit.components) std::ranges::shuffle(one.attributes, random);
  for (TextRelation& one : unit.relations) std::ranges::shuffle(one.refs, random);
  return unit;
}

// The same in other units of the format's data model, or of its makers.
inline TextUnit in_other_units(TextUnit unit) {
  const double pi = 3.14159265358979323846;
  const std::map<std::string, std::pair<std::string, double>> kOthers = {
      {"mm", {"m", 1e-3}},
      {"deg", {"rad", pi / 180.0}},
      {"1 / min", {"rad / s", pi / 30.0}},
      {"N m", {"kN m", 1e-3}},
      {"kg / dm^3", {"kg / m^3", 1e3}},
      {"N / m", {"N / mum", 1e-6}},
      {"N / mm^2", {"GPa", 1e-3}},
      {"none", {"", 1.0}}};
  for (TextComponent& one : unit.components) {
    for (TextAttribute& attribute : one.attributes) {
      const auto other = kOthers.find(attribute.unit);
      char* end = nullptr;
      const double number = std::strtod(attribute.text.c_str(), &end);
      if (other == kOthers.end() || *end != '\0' || attribute.text.empty()) continue;
      attribute.unit = other->second.first;
      attribute.text = fmt::format("{:.17g}", number * other->second.second);
    }
  }
  return unit;
}

// What the names of some components' types were before version 1.2 or so.
inline TextUnit with_older_names(TextUnit unit, const std::string& version) {
  unit.version = version;
  for (TextComponent& one : unit.components) {
    if (one.type == "cylindrical_gear_flank") one.type = "flank_geometry";
    if (one.type == "cylindrical_stage_gear_data") one.type = "stage_gear_data";
  }
  return unit;
}

// The relations that newer versions have beside the older ones.
inline TextUnit with_newer_relations(TextUnit unit) {
  unit.version = "1.7";
  for (TextRelation& one : unit.relations) {
    if (one.type == "assembly") one.type = "ordered_assembly";
    if (one.type == "reference") one.type = "ordered_reference";
    if (one.type != "side") continue;
    one.type = "contact";
    for (auto& [role, id] : one.refs) {
      if (role == "inner_part") role = "side_1";
      if (role == "outer_part") role = "side_2";
    }
  }
  return unit;
}

// Builds a unit shaft by shaft.
class UnitBuilder {
 public:
  TextUnit unit;

  // A steel cylinder from 0 to its length, whose axis is at this height.
  void shaft(const std::string& id, double height, double diameter, double length) {
    add(id, "shaft",
        {{"support_vector", "mm", fmt::format("[0, 0, {}]", height)},
         {"u_axis_vector", "mm", "[1, 0, 0]"},
         {"reference_component_for_position", "none", "1"}});
    const std::string section = "91" + id;
    add(section, "shaft_section",
        {{"u_coordinate_on_shaft", "mm", "0"},
         {"length", "mm", fmt::format("{}", length)},
         {"outer_diameter_begin", "mm", fmt::format("{}", diameter)},
         {"outer_diameter_end", "mm", fmt::format("{}", diameter)}});
    relate("assembly", {{"assembly", id}, {"part", section}});
    relate("assembly", {{"assembly", "1"}, {"part", id}});
  }

  void gear(const std::string& id, const std::string& shaft, int teeth, double module, double helix,
            double place, const std::string& type = "cylindrical_gear") {
    add(id, type,
        {{"number_of_teeth", "none", fmt::format("{}", teeth)},
         {"normal_module", "mm", fmt::format("{}", module)},
         {"helix_angle_reference_diameter", "deg", fmt::format("{}", helix)},
         {"face_width", "mm", "30"},
         {"u_coordinate_on_shaft", "mm", fmt::format("{}", place)}});
    relate("assembly", {{"assembly", shaft}, {"part", id}});
    for (const std::string& side : {std::string("left"), std::string("right")}) {
      const std::string flank = (side == "left" ? "92" : "93") + id;
      add(flank, "cylindrical_gear_flank",
          {{"normal_pressure_angle", "deg", "20"},
           {"addendum_modification_coefficient", "none", "0"}});
      relate("flank", {{"gear", id}, {side, flank}});
    }
  }

  void stage(const std::string& id, const std::string& first, const std::string& second,
             double centre) {
    add(id, "cylindrical_stage", {{"center_distance", "mm", fmt::format("{:.12g}", centre)}});
    relate("stage", {{"stage", id}, {"gear_1", first}, {"gear_2", second}});
    relate("assembly", {{"assembly", "1"}, {"part", id}});
  }

  // Whether a gear drives in a stage.
  void drives(const std::string& stage, const std::string& gear, bool is_driver) {
    const std::string data = "94" + stage + gear;
    add(data, "cylindrical_stage_gear_data",
        {{"is_driving_gear", "none", is_driver ? "true" : "false"}});
    relate("stage_gear_data", {{"stage", stage}, {"gear", gear}, {"stage_gear_data", data}});
  }

  void load(const std::string& shaft, double torque, double speed) {
    unit.set(shaft, "rotational_speed", "1 / min", fmt::format("{}", speed));
    add("95" + shaft, "external_load",
        {{"torque_around_u_axis", "N m", fmt::format("{}", torque)},
         {"transmits_torque", "none", "true"}});
    relate("assembly", {{"assembly", shaft}, {"part", "95" + shaft}});
  }

  void add(const std::string& id, const std::string& type, std::vector<TextAttribute> attributes) {
    unit.components.push_back({id, type, type + " " + id, std::move(attributes)});
  }
  void relate(const std::string& type, std::vector<std::pair<std::string, std::string>> refs) {
    unit.relations.push_back({type, std::move(refs)});
  }
};

// 20/41 teeth of module 3 mm and 18/45 of module 4 mm, spur gears; 50 N m at 1230 rpm come in.
inline UnitBuilder two_stages() {
  UnitBuilder built;
  built.add("1", "gear_unit", {});
  built.shaft("2", 0.0, 30.0, 100.0);
  built.shaft("3", 91.5, 40.0, 150.0);
  built.shaft("4", 217.5, 50.0, 120.0);
  built.gear("20", "2", 20, 3.0, 0.0, 40.0);
  built.gear("21", "3", 41, 3.0, 0.0, 30.0);
  built.gear("22", "3", 18, 4.0, 0.0, 110.0);
  built.gear("23", "4", 45, 4.0, 0.0, 60.0);
  built.stage("50", "20", "21", 91.5);
  built.stage("51", "22", "23", 126.0);
  built.load("2", 50.0, 1230.0);
  return built;
}

// The same with a third stage of 23/37 teeth behind it.
inline UnitBuilder three_stages() {
  UnitBuilder built = two_stages();
  built.shaft("5", 367.5, 60.0, 130.0);
  built.gear("24", "4", 23, 5.0, 0.0, 100.0);
  built.gear("25", "5", 37, 5.0, 0.0, 60.0);
  built.stage("52", "24", "25", 150.0);
  return built;
}

// A sun of 24 teeth, planets of 18, a ring of 60 that the casing holds; 90 N m at 1000 rpm. A
// carrier with pins, and `count` planets.
inline UnitBuilder planetary_set(int count) {
  UnitBuilder built;
  built.add("1", "gear_unit", {});
  built.add("6", "gear_casing", {});
  built.add("7", "planetary_stage", {});
  built.add("8", "planet_carrier", {});
  built.add("9", "coupling", {});
  built.shaft("2", 0.0, 20.0, 80.0);
  built.shaft("3", 0.0, 150.0, 10.0);
  built.shaft("4", 0.0, 40.0, 60.0);
  built.gear("20", "2", 24, 2.0, 0.0, 40.0);
  built.gear("30", "3", -60, 2.0, 0.0, 5.0);
  built.relate("side", {{"assembly", "9"}, {"inner_part", "3"}, {"outer_part", "6"}});
  built.relate("assembly", {{"assembly", "7"}, {"part", "8"}});
  built.relate("assembly", {{"assembly", "8"}, {"part", "4"}});
  built.relate("planet_carrier_shaft", {{"planetary_stage", "7"}, {"shaft", "4"}});
  for (int i = 0; i < count; ++i) {
    const std::string shaft = fmt::format("6{}", i), pin = fmt::format("5{}", i);
    const std::string gear = fmt::format("4{}", i);
    built.shaft(shaft, 42.0, 20.0, 30.0);
    built.shaft(pin, 42.0, 12.0, 50.0);
    built.relate("planet_pin", {{"planetary_stage", "7"}, {"shaft", pin}});
    built.relate("assembly", {{"assembly", "8"}, {"part", pin}});
    built.gear(gear, shaft, 18, 2.0, 0.0, 15.0);
    built.stage(fmt::format("7{}", i), "20", gear, 42.0);
    built.stage(fmt::format("8{}", i), gear, "30", 42.0);
    for (const char* mesh : {"7", "8"}) {
      built.relate("assembly", {{"assembly", "7"}, {"part", fmt::format("{}{}", mesh, i)}});
    }
  }
  built.load("2", 90.0, 1000.0);
  return built;
}

}  // namespace gearsweep::testing
