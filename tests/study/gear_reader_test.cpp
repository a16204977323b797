// The [gear] table of a study: what is refused, and where.
#include "study/detail/gear_reader.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <iterator>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "model/error.hpp"
#include "study/builtin_models.hpp"

namespace gearsweep {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

using Table = std::map<std::string, std::string>;

// The paper's Table 1 with the mesh stiffness that the model's description chooses.
Table table_1() {
  return {{"teeth", "[40, 40]"},
          {"module_mm", "3"},
          {"inertia_kg_mm2", "2230"},
          {"mass_kg", "1.0"},
          {"bearing_stiffness_N_per_mm", "3.0e5"},
          {"bearing_damping_N_s_per_mm", "1.4"},
          {"mesh_damping_N_s_per_mm", "0.7"},
          {"half_backlash_mm", "0.05"},
          {"mesh_stiffness_N_per_m", "2.174e8"},
          {"torque_N_m", "61"},
          {"transmission_error_um", "10"}};
}

Table with(Table table, const std::string& key, const std::string& value) {
  table[key] = value;
  return table;
}

Table without(Table table, const std::string& key) {
  table.erase(key);
  return table;
}

// Line 1 is "[gear]"; the keys follow in alphabetical order.
void convert(const Table& table) {
  std::string text = "[gear]\n";
  for (const auto& [key, value] : table) text += key + " = " + value + "\n";
  const toml::table study = toml::parse(text, std::string_view("study.toml"));
  const Model& model = *find_model("gear5");
  const DrawingTable gear = drawing_tables(study, model).front();
  convert_gear(read_drawing(gear, {}), model, gear);
}

std::string line_of(const Table& table, const std::string& key) {
  return "study.toml:" + std::to_string(2 + std::distance(table.begin(), table.find(key))) + ": ";
}

std::string message_of(const Table& table) {
  try {
    convert(table);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(GearReader, AMissingKeyIsNamedWithItsMeaning) {
  for (const auto& [key, value] : table_1()) {
    const std::string message = message_of(without(table_1(), key));
    EXPECT_THAT(message, AllOf(HasSubstr("study.toml:1: [gear] needs"), HasSubstr(key)));
  }
}

TEST(GearReader, AnUnknownKeyComesBeforeTheOneItWasMeantToBe) {
  const Table table = with(without(table_1(), "module_mm"), "modul_mm", "3");
  EXPECT_EQ(message_of(table), line_of(table, "modul_mm") +
                                   "unknown key 'modul_mm' in [gear]; did you mean 'module_mm'?");
}

TEST(GearReader, ListsHaveTheLengthOfWhatTheyDescribe) {
  for (const auto& [key, list] : Table{{"mass_kg", "[1.0]"},
                                       {"inertia_kg_mm2", "[1, 2, 3]"},
                                       {"teeth", "[40, 40, 40]"},
                                       {"bearing_stiffness_N_per_mm", "[3e5, 3e5]"},
                                       {"bearing_damping_N_s_per_mm", "[]"}}) {
    const Table table = with(table_1(), key, list);
    EXPECT_THAT(message_of(table),
                AllOf(HasSubstr(line_of(table, key)), HasSubstr("one number or a list of")));
  }
}

TEST(GearReader, TeethAreTwoWholeNumbers) {
  for (const char* teeth : {"40", "[40.5, 40]", "[40, 'x']", "[2, 40]", "[40, nan]"}) {
    const Table table = with(table_1(), "teeth", teeth);
    EXPECT_THAT(message_of(table), AllOf(HasSubstr(line_of(table, "teeth")), HasSubstr("teeth")))
        << teeth;
  }
}

// Each is wrong by itself or leads to a parameter that gear5 does not take.
TEST(GearReader, NumbersOutOfRangeAreRefusedAtTheirLine) {
  for (const auto& [key, value] : std::vector<std::pair<std::string, std::string>>{
           {"inertia_kg_mm2", "0"},
           {"inertia_kg_mm2", "-2230"},
           {"inertia_kg_mm2", "[2230, inf]"},
           {"mass_kg", "0"},
           {"mass_kg", "1e-6"},
           {"module_mm", "0"},
           {"half_backlash_mm", "0"},
           {"half_backlash_mm", "50"},
           {"mesh_stiffness_N_per_m", "0"},
           {"mesh_stiffness_N_per_m", "'stiff'"},
           {"bearing_stiffness_N_per_mm", "0"},
           {"mesh_damping_N_s_per_mm", "-0.7"},
           {"torque_N_m", "-61"},
           {"transmission_error_um", "-1"},
           {"pressure_angle_deg", "90"},
           {"pinion_speed_rpm", "0"},
           {"contact_ratio", "1.0"},
           {"contact_ratio", "2.0"},
           {"contact_ratio", "0.5"},
           {"addendum_mm", "1.0"},  // contact ratio below 1
           {"addendum_mm", "4.5"},  // contact ratio above 2
           {"addendum_mm", "-3"},
           {"centre_distance_mm", "112"},  // base circles overlap
           {"centre_distance_mm", "130"},  // the tips do not meet
       }) {
    const Table table = with(table_1(), key, value);
    EXPECT_THAT(message_of(table), AllOf(HasSubstr(line_of(table, key)), HasSubstr(key)))
        << key << " = " << value;
  }
}

}  // namespace
}  // namespace gearsweep
