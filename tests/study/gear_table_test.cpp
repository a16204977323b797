// A [gear] table against the paper's Table 1, ISO 6336-1 and an unequal pair worked out elsewhere.
#include "study/detail/gear_table.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
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

Table unequal_pair() {
  return {{"teeth", "[20, 40]"},
          {"module_mm", "4.0"},
          {"addendum_mm", "[4.5, 3.5]"},
          {"inertia_kg_mm2", "[600, 9000]"},
          {"mass_kg", "[0.9, 3.2]"},
          {"bearing_stiffness_N_per_mm", "[1e5, 2e5, 3e5, 4e5]"},
          {"bearing_damping_N_s_per_mm", "[1.0, 2.0, 3.0, 4.0]"},
          {"mesh_damping_N_s_per_mm", "0.5"},
          {"half_backlash_mm", "0.04"},
          {"face_width_mm", "25"},
          {"torque_N_m", "150"},
          {"transmission_error_um", "6"},
          {"pinion_speed_rpm", "3000"}};
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
GearConversion convert(const Table& table) {
  std::string text = "[gear]\n";
  for (const auto& [key, value] : table) text += key + " = " + value + "\n";
  const toml::table study = toml::parse(text, std::string_view("study.toml"));
  return convert_gear(*study["gear"].as_table());
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

bool has(const GearConversion& gear, const std::string& name) {
  return std::any_of(gear.parameters.begin(), gear.parameters.end(),
                     [&](const GearParameter& parameter) { return parameter.name == name; });
}

GearParameter parameter_of(const GearConversion& gear, const std::string& name) {
  for (const GearParameter& parameter : gear.parameters) {
    if (parameter.name == name) return parameter;
  }
  ADD_FAILURE() << "no parameter " << name;
  return {};
}

double value_of(const GearConversion& gear, const std::string& name) {
  return parameter_of(gear, name).value;
}

std::string notes_of(const GearConversion& gear) {
  std::string all;
  for (const std::string& note : gear.notes) all += note + "\n";
  return all;
}

// A dozen operations in double precision, each wrong by 1.1e-16 at most.
constexpr double kRounding = 1e-14;

void expect_value(const GearConversion& gear, const std::string& name, double expected) {
  EXPECT_NEAR(value_of(gear, name), expected, kRounding * std::fabs(expected)) << name;
}

TEST(GearTable, TableOneOfThePaperGivesThePresetConsistent) {
  const GearConversion gear = convert(with(table_1(), "contact_ratio", "1.718"));
  const Model& model = *find_model("gear5");
  for (const char* name : {"b",     "F1", "e0",    "zeta",  "m1", "m2",         "k1",  "k2",
                           "k3",    "k4", "c1",    "c2",    "c3", "c4",         "eps", "approach",
                           "alpha", "A",  "rho_p", "rho_g", "zp", "teeth_ratio"}) {
    const auto index = static_cast<std::size_t>(model.find_parameter(name));
    const double preset = model.parameters[index].default_value;
    // The preset's numbers are rounded to 2 digits (F1, from 61 N m) or more.
    EXPECT_NEAR(value_of(gear, name), preset, 0.005 * preset) << name;
  }
  EXPECT_EQ(gear.parameters.size(), 22U);
}

// mpmath, 30 digits, from the formulas in the header.
TEST(GearTable, TableOneInAllDigits) {
  const GearConversion gear = convert(table_1());
  expect_value(gear, "m1", 0.350752466540680712);
  expect_value(gear, "m2", 0.350752466540680712);
  expect_value(gear, "zeta", 0.0400809408602008825);
  expect_value(gear, "k1", 1.37994480220791168);
  expect_value(gear, "c4", 2.0);
  expect_value(gear, "A", 2400.0);
  expect_value(gear, "F1", 0.0995321130343922677);
  expect_value(gear, "e0", 0.2);
  // A difference of lengths ten times as great as itself: one digit less.
  EXPECT_NEAR(value_of(gear, "eps"), 1.71353362376776214, 10.0 * kRounding);
  EXPECT_NEAR(gear.scales.varpi, 24895.9901228790640, 24896.0 * kRounding);
  EXPECT_NEAR(gear.scales.rpm_per_omega, 5943.47983683480871, 5943.0 * kRounding);
  EXPECT_DOUBLE_EQ(gear.scales.b_n, 5e-5);
  EXPECT_DOUBLE_EQ(gear.scales.k0, 2.174e8);
  EXPECT_THAT(notes_of(gear), AllOf(HasSubstr("Rp = 56.38156 mm"), HasSubstr("me = 0.350752 kg"),
                                    HasSubstr("Ip/Rp^2 = 0.701505 kg"), HasSubstr("1.71353")));
}

TEST(GearTable, EqualGearsAreExactlySymmetric) {
  const GearConversion gear = convert(table_1());
  EXPECT_EQ(value_of(gear, "approach"), 0.5);
  EXPECT_EQ(value_of(gear, "rho_p"), 0.5);
  EXPECT_EQ(value_of(gear, "rho_g"), 0.5);
  EXPECT_EQ(value_of(gear, "b"), 1.0);
}

TEST(GearTable, NotesSayHowANumberCameAbout) {
  const GearConversion gear = convert(table_1());
  EXPECT_EQ(parameter_of(gear, "m1").note, "me/mp = 0.350752 kg / 1 kg");
  EXPECT_EQ(parameter_of(gear, "A").note, "a/b_n = 0.12 m / 5e-05 m");
}

TEST(GearTable, FaceWidthGivesTheStiffnessOfIso6336) {
  Table table = with(without(table_1(), "mesh_stiffness_N_per_m"), "face_width_mm", "10");
  table["contact_ratio"] = "1.718";
  const GearConversion gear = convert(table);
  // c' = 0.78/0.0575655 and c_gamma = c' (0.75 1.718 + 0.25), by hand; 10 mm wide.
  EXPECT_NEAR(gear.scales.k0, 208463402.558824296, 2.1e8 * kRounding);
  EXPECT_THAT(notes_of(gear), AllOf(HasSubstr("q' = 0.0575655"), HasSubstr("c' = 13.5498"),
                                    HasSubstr("c_gamma = 20.8463")));
}

// The second factor of C_B, 1 - 0.02 (20 - alpha_n): 1.05 and 1.1 times the c' of the same teeth at
// 20 degrees, 0.9 times at 15. It takes the pressure angle of the normal section.
TEST(GearTable, TheStiffnessGrowsWithThePressureAngle) {
  Table table = with(without(table_1(), "mesh_stiffness_N_per_m"), "face_width_mm", "10");
  table["contact_ratio"] = "1.5";
  const auto k0 = [](const Table& of) { return convert(of).scales.k0; };
  const auto ratio_at = [&](const char* degrees) {
    return k0(with(table, "pressure_angle_deg", degrees)) / k0(table);
  };
  EXPECT_EQ(ratio_at("20"), 1.0);
  EXPECT_NEAR(ratio_at("22.5"), 1.05, kRounding);
  EXPECT_NEAR(ratio_at("25"), 1.1, kRounding);
  EXPECT_NEAR(ratio_at("15"), 0.9, kRounding);
  // c' = 0.8 x 0.975 x 1.1 / q' by hand.
  EXPECT_THAT(notes_of(convert(with(table, "pressure_angle_deg", "25"))),
              AllOf(HasSubstr("C_B = 1.0725"), HasSubstr("c' = 14.9048")));
  table["dedendum_mm"] = "3.6";
  EXPECT_NEAR(ratio_at("25"), 1.1, kRounding);
  table["helix_angle_deg"] = "20";
  EXPECT_NEAR(ratio_at("25"), 1.1, kRounding);
}

// Of 20 and 30 teeth of module 4 with x1 + x2 = 0.28 by bisection elsewhere: 101.0777 mm without
// play. Drawings round.
TEST(GearTable, RefusesWhatCannotBeAssembled) {
  const Table shifted = with(with(with(table_1(), "teeth", "[20, 30]"), "module_mm", "4"),
                             "profile_shift", "[0.28, 0]");
  const auto at = [&](const char* centre) { return with(shifted, "centre_distance_mm", centre); };
  EXPECT_THAT(message_of(at("100")),
              AllOf(HasSubstr(line_of(at("100"), "centre_distance_mm")),
                    HasSubstr("centre_distance_mm = 100 is too small"), HasSubstr("101.078 mm")));
  EXPECT_THAT(message_of(at("101.06")), HasSubstr("too small"));
  for (const char* centre : {"101.07", "101.08", "101.5"})
    EXPECT_EQ(message_of(at(centre)), "accepted");
  EXPECT_THAT(message_of(with(table_1(), "centre_distance_mm", "119.9")), HasSubstr("too small"));
  EXPECT_EQ(message_of(with(table_1(), "centre_distance_mm", "119.999")), "accepted");
  // The flanks of a tooth of this pinion meet at 92.3 mm, by bisection elsewhere.
  const Table pointed = without(unequal_pair(), "addendum_mm");
  const auto tips = [&](const char* both) { return with(pointed, "tip_diameter_mm", both); };
  EXPECT_EQ(message_of(tips("[91, 167]")), "accepted");
  EXPECT_THAT(message_of(tips("[93, 167]")), HasSubstr("teeth of the pinion come to a point"));
}

TEST(GearTable, DoubtsWhatIsFarFromAnyGear) {
  EXPECT_THAT(convert(table_1()).doubts, ::testing::IsEmpty());
  EXPECT_THAT(convert(unequal_pair()).doubts, ::testing::IsEmpty());
  const auto doubts = [](const Table& table) { return convert(table).doubts; };
  const Table wide = with(unequal_pair(), "face_width_mm", "250");
  EXPECT_THAT(doubts(wide),
              ::testing::Contains(AllOf(HasSubstr(line_of(wide, "face_width_mm")),
                                        HasSubstr("3.12 times the pinion's reference diameter"))));
  const Table heavy = with(unequal_pair(), "mass_kg", "[900, 3.2]");
  EXPECT_THAT(doubts(heavy), ::testing::Contains(HasSubstr("mass_kg = 900 of the pinion")));
  EXPECT_THAT(doubts(with(table_1(), "mass_kg", "900")), ::testing::Not(::testing::IsEmpty()));
  const Table in_cm2 = with(unequal_pair(), "inertia_kg_mm2", "[6, 90]");
  EXPECT_THAT(doubts(in_cm2), ::testing::SizeIs(2));
  EXPECT_THAT(doubts(with(table_1(), "half_backlash_mm", "1")), ::testing::SizeIs(1));
}

// mpmath, 30 digits; the path of contact by coordinates on the line of action (entry, pitch point
// and exit measured from the pinion's base tangent point), not by the two halves used in the code.
TEST(GearTable, UnequalPairWithUnequalAddenda) {
  const GearConversion gear = convert(unequal_pair());
  EXPECT_NEAR(value_of(gear, "eps"), 1.61936731275455657, 10.0 * kRounding);
  EXPECT_NEAR(value_of(gear, "approach"), 0.469748121726293, 10.0 * kRounding);
  EXPECT_EQ(value_of(gear, "teeth_ratio"), 2.0);
  EXPECT_EQ(value_of(gear, "zp"), 20.0);
  expect_value(gear, "rho_p", 15.0 / 19.0);
  expect_value(gear, "rho_g", 4.0 / 19.0);
  expect_value(gear, "m1", 0.372524451128879680);
  expect_value(gear, "m2", 0.104772501879997410);
  // These go with k0, which has the contact ratio's last digit.
  EXPECT_NEAR(gear.scales.k0, 464714997.970577470, 4.6e8 * 10.0 * kRounding);
  EXPECT_NEAR(value_of(gear, "zeta"), 0.0200284812291190789, 10.0 * kRounding);
  EXPECT_NEAR(value_of(gear, "k1"), 0.215185652360484622, 10.0 * kRounding);
  EXPECT_NEAR(value_of(gear, "k4"), 0.860742609441938488, 10.0 * kRounding);
  EXPECT_NEAR(value_of(gear, "F1"), 0.214683551435396747, 10.0 * kRounding);
  EXPECT_NEAR(value_of(gear, "omega"), 0.168766082879705092, 10.0 * kRounding);
  expect_value(gear, "c1", 2.0);
  expect_value(gear, "c4", 8.0);
  expect_value(gear, "e0", 0.15);
  expect_value(gear, "A", 3000.0);
}

TEST(GearTable, SpeedIsOmegaOnlyWhenGiven) {
  EXPECT_FALSE(has(convert(table_1()), "omega"));
  const GearConversion gear = convert(with(table_1(), "pinion_speed_rpm", "1000"));
  expect_value(gear, "omega", 0.168251601326630983);
  expect_value(gear, "omega", 1000.0 / gear.scales.rpm_per_omega);
}

TEST(GearTable, AGivenContactRatioKeepsTheSplitAtThePitchPoint) {
  const GearConversion drawn = convert(unequal_pair());
  const GearConversion given = convert(with(unequal_pair(), "contact_ratio", "1.5"));
  EXPECT_EQ(value_of(given, "eps"), 1.5);
  EXPECT_EQ(value_of(given, "approach"), value_of(drawn, "approach"));
  EXPECT_THAT(notes_of(given), HasSubstr("contact ratio 1.5 as given"));
}

TEST(GearTable, ALongerAddendumOfTheGearLengthensTheApproach) {
  const GearConversion gear = convert(with(table_1(), "addendum_mm", "[3.0, 3.2]"));
  EXPECT_GT(value_of(gear, "approach"), 0.5);
}

// Same method as for the unequal pair, with cos(alpha_w) = (Rp + Rg)/120.8 mm.
TEST(GearTable, AWiderCentreDistanceWorksAtItsOwnPressureAngle) {
  Table table = with(unequal_pair(), "centre_distance_mm", "120.8");
  table.erase("addendum_mm");
  const GearConversion gear = convert(table);
  // The arc cosine is steep here by 1/tan(alpha_w) = 2.6; in degrees.
  EXPECT_NEAR(value_of(gear, "alpha"), 21.0177292189549613, 21.0 * 10.0 * kRounding);
  EXPECT_NEAR(value_of(gear, "eps"), 1.44182348234448357, 50.0 * kRounding);
  EXPECT_NEAR(value_of(gear, "approach"), 0.504818030763626440, 50.0 * kRounding);
  expect_value(gear, "A", 3020.0);
}

TEST(GearTable, TheStandardCentreDistanceChangesNothing) {
  const GearConversion gear = convert(with(table_1(), "centre_distance_mm", "120"));
  const GearConversion rounded = convert(with(table_1(), "centre_distance_mm", "120.00001"));
  EXPECT_EQ(value_of(gear, "alpha"), value_of(convert(table_1()), "alpha"));
  EXPECT_EQ(value_of(rounded, "alpha"), value_of(gear, "alpha"));
  EXPECT_EQ(value_of(gear, "eps"), value_of(convert(table_1()), "eps"));
}

TEST(GearTable, WithoutMeshDampingThereIsNoBearingDamping) {
  Table table = with(table_1(), "mesh_damping_N_s_per_mm", "0");
  EXPECT_THAT(message_of(table), HasSubstr("c = C/cm"));
  table["bearing_damping_N_s_per_mm"] = "0";
  const GearConversion gear = convert(table);
  EXPECT_EQ(value_of(gear, "zeta"), 0.0);
  EXPECT_EQ(value_of(gear, "c1"), 0.0);
}

TEST(GearTable, AMissingKeyIsNamedWithItsMeaning) {
  for (const auto& [key, value] : table_1()) {
    const std::string message = message_of(without(table_1(), key));
    EXPECT_THAT(message,
                AllOf(HasSubstr("study.toml:1: [gear] needs"), HasSubstr("'" + key + "'")));
  }
}

TEST(GearTable, AnUnknownKeyComesBeforeTheOneItWasMeantToBe) {
  const Table table = with(without(table_1(), "module_mm"), "modul_mm", "3");
  EXPECT_EQ(message_of(table), line_of(table, "modul_mm") +
                                   "unknown key 'modul_mm' in [gear]; did you mean 'module_mm'?");
}

TEST(GearTable, BothStiffnessKeysAreOneTooMany) {
  const Table table = with(table_1(), "face_width_mm", "10");
  EXPECT_THAT(message_of(table), AllOf(HasSubstr(line_of(table, "face_width_mm")),
                                       HasSubstr("mesh_stiffness_N_per_m"), HasSubstr("keep one")));
}

TEST(GearTable, ListsHaveTheLengthOfWhatTheyDescribe) {
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

TEST(GearTable, TeethAreTwoWholeNumbers) {
  for (const char* teeth : {"40", "[40.5, 40]", "[40, 'x']", "[2, 40]", "[40, nan]"}) {
    const Table table = with(table_1(), "teeth", teeth);
    EXPECT_THAT(message_of(table), AllOf(HasSubstr(line_of(table, "teeth")), HasSubstr("teeth")))
        << teeth;
  }
}

// Each is wrong by itself or leads to a parameter that gear5 does not take.
TEST(GearTable, NumbersOutOfRangeAreRefusedAtTheirLine) {
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

std::string options_of(const GearConversion& gear) {
  std::string all;
  for (const GearOption& option : gear.options) all += option.name + " = " + option.choice + "\n";
  return all;
}

TEST(GearTable, HarmonicsOfTheErrorAreALongList) {
  Table table = with(table_1(), "transmission_error_um", "[10, 2, 0.5]");
  table["transmission_error_phase_deg"] = "[0, 90]";
  const GearConversion gear = convert(table);
  expect_value(gear, "e0", 0.2);
  expect_value(gear, "e0_2", 0.04);
  expect_value(gear, "e0_3", 0.01);
  expect_value(gear, "e0_phase_2", std::acos(0.0));
  EXPECT_FALSE(has(gear, "e0_4"));
  EXPECT_FALSE(has(gear, "cycle"));
  EXPECT_EQ(options_of(gear), "error = series\n");
  EXPECT_EQ(options_of(convert(table_1())), "");
  EXPECT_THAT(message_of(with(table_1(), "transmission_error_um", "[1, 2, 3, 4, 5, 6, 7, 8, 9]")),
              HasSubstr("has 9 numbers; 1 to 8 is possible"));
  EXPECT_THAT(message_of(with(table_1(), "transmission_error_um", "[]")), HasSubstr("0 numbers"));
  EXPECT_THAT(message_of(with(table_1(), "transmission_error_phase_deg", "[1, 2]")),
              HasSubstr("at most one for each harmonic"));
}

// What one gear has comes back once per turn of it; what both have, when the same two teeth meet.
TEST(GearTable, FaultsChooseTheCycle) {
  const Table pair = with(unequal_pair(), "teeth", "[23, 47]");
  const auto cycle = [&](const std::string& key, const std::string& value) {
    const GearConversion gear = convert(with(without(pair, "addendum_mm"), key, value));
    return has(gear, "cycle") ? value_of(gear, "cycle") : 1.0;
  };
  EXPECT_EQ(cycle("runout_um", "[30, 0]"), 23.0);
  EXPECT_EQ(cycle("runout_um", "[0, 30]"), 47.0);
  EXPECT_EQ(cycle("runout_um", "30"), 1081.0);
  EXPECT_EQ(cycle("damage", "[0.3, 0]"), 23.0);
  EXPECT_EQ(cycle("damage", "[0, 0.3]"), 47.0);
  EXPECT_EQ(cycle("damage", "0"), 1.0);
  EXPECT_EQ(cycle("runout_phase_deg", "90"), 1.0);
  const GearConversion gear = convert(with(table_1(), "runout_um", "[30, 20]"));
  EXPECT_EQ(value_of(gear, "cycle"), 40.0);
  expect_value(gear, "runout_p", 0.6);
  expect_value(gear, "runout_g", 0.4);
  EXPECT_EQ(options_of(gear), "error = series\n");
  EXPECT_EQ(options_of(convert(with(table_1(), "damage", "[0.5, 0]"))), "");
  EXPECT_THAT(message_of(with(table_1(), "damage", "1.5")), HasSubstr("damage"));
}

// Teeth 12 and 24 of module 3 mm with shifts 0.6 and 0.36: KHK, Gear Technical Reference, table
// 4.3, has alpha_w = 26.0886 degrees and a centre distance of 56.4999 mm.
TEST(GearTable, ProfileShiftGivesTheWorkingPressureAngle) {
  Table table = with(table_1(), "teeth", "[12, 24]");
  table["profile_shift"] = "[0.6, 0.36]";
  table["tip_diameter_mm"] = "[44.84, 79.4]";
  const GearConversion gear = convert(table);
  EXPECT_NEAR(value_of(gear, "alpha"), 26.0886, 5e-5);
  EXPECT_NEAR(value_of(gear, "A") * 0.05, 56.4999, 5e-5);
  // The same gear by its centre distance.
  const double centre = value_of(gear, "A") * 0.05;
  table["centre_distance_mm"] = fmt::format("{}", centre);
  EXPECT_NEAR(value_of(convert(table), "alpha"), value_of(gear, "alpha"), 1e-9);
  EXPECT_NEAR(value_of(convert(table), "eps"), value_of(gear, "eps"), 1e-9);
}

TEST(GearTable, TipDiametersAreTwiceTheReferenceRadiusAndTheAddendum) {
  const GearConversion own = convert(table_1());
  const GearConversion tips = convert(with(table_1(), "tip_diameter_mm", "126"));
  EXPECT_NEAR(value_of(tips, "eps"), value_of(own, "eps"), 1e-14);
  Table both = with(table_1(), "tip_diameter_mm", "126");
  both["addendum_mm"] = "3";
  EXPECT_THAT(message_of(both), HasSubstr("keep one"));
  // A shift of one gear against the other leaves the centre distance, and moves the pitch point.
  const GearConversion shifted = convert(with(table_1(), "profile_shift", "[0.2, -0.2]"));
  EXPECT_EQ(value_of(shifted, "alpha"), value_of(own, "alpha"));
  EXPECT_LT(value_of(shifted, "approach"), 0.5);
}

TEST(GearTable, AContactRatioOutOfRangeIsExplained) {
  const Table table = with(table_1(), "addendum_mm", "1.0");
  EXPECT_THAT(message_of(table),
              AllOf(HasSubstr("addendum_mm gives eps = "), HasSubstr("contact ratio"),
                    HasSubstr("from 1.001 to 1.999 is allowed")));
}

// A rack of standard addendum undercuts 20 degree pinions of fewer than 17 teeth, and a gear of 40
// teeth those of fewer than 15.
TEST(GearTable, TipsThatWouldUndercutTheMateAreRefused) {
  EXPECT_THAT(message_of(with(table_1(), "teeth", "[12, 40]")),
              AllOf(HasSubstr("interference"), HasSubstr("pinion's base circle")));
  EXPECT_THAT(message_of(with(table_1(), "teeth", "[40, 12]")), HasSubstr("gear's base circle"));
  EXPECT_EQ(message_of(with(table_1(), "teeth", "[17, 40]")), "accepted");
}

}  // namespace
}  // namespace gearsweep
