// Gear units in REXS: their numbers by hand, and what is refused.
#include "rexs/gear_unit.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "model/error.hpp"
#include "rexs/detail/values.hpp"
#include "rexs/stage_choice.hpp"
#include "rexs/stage_drawing.hpp"
#include "rexs/units.hpp"
#include "study/imported_gear.hpp"

namespace gearsweep::testing {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

GearUnit unit_of(const std::string& text) { return gear_unit_of(read_rexs(text, "unit")); }

// A cylinder of 100 x 40 mm; a cone from 40 to 20 mm over 50 mm with a bore of 10 mm; discs of 120
// and 125 mm, 30 mm wide, that stand beside the shaft's sections. By integrals of their own.
TEST(Rexs, WeighsASteppedShaft) {
  const GearUnit unit = unit_of(two_stage_xml());
  const double pi = std::numbers::pi, density = 7e-6;
  double mass = 0.0, inertia = 0.0;
  const auto slice = [&](double width, double outer, double inner) {
    const double a = outer * outer / 4.0, b = inner * inner / 4.0;
    mass += density * pi * width * (a - b);
    inertia += 0.5 * density * pi * width * (a * a - b * b);
  };
  slice(100.0, 40.0, 0.0);
  constexpr int kSlices = 20000;  // the midpoint rule leaves 1e-9
  for (int i = 0; i < kSlices; ++i) {
    slice(50.0 / kSlices, 40.0 - 20.0 * (i + 0.5) / kSlices, 10.0);
  }
  slice(30.0, 120.0, 0.0);
  slice(30.0, 125.0, 0.0);
  EXPECT_NEAR(unit.shafts[1].mass / mass, 1.0, 1e-7);
  EXPECT_NEAR(unit.shafts[1].inertia / inertia, 1.0, 1e-7);
}

// 60 N m at 600 rpm come to the second stage as 120 N m at 300 rpm.
TEST(Rexs, CarriesLoadsFromStageToStage) {
  const GearUnit unit = unit_of(two_stage_xml());
  EXPECT_NEAR(*unit.cases[0].torques[0], 60.0, 1e-9);
  EXPECT_NEAR(*unit.cases[0].torques[1], 120.0, 1e-9);
  EXPECT_NEAR(*unit.cases[0].speeds[0], 600.0, 1e-9);
  EXPECT_NEAR(*unit.cases[0].speeds[1], 300.0, 1e-9);
}

// 60 N m come in, and 240 N m go out behind ratios of 2 and 2.
TEST(Rexs, TellsLoadsThatDoNotBalance) {
  const auto with_output = [](const std::string& torque) {
    std::string text = two_stage_xml();
    const std::string none = "<attribute id=\"transmits_torque\" unit=\"\">true</attribute>";
    return text.replace(
        text.find(none), none.size(),
        "<attribute id=\"torque_around_u_axis\" unit=\"N m\">" + torque + "</attribute>");
  };
  EXPECT_THAT(unit_of(with_output("-240")).notes, Not(Contains(HasSubstr("do not balance"))));
  EXPECT_THAT(unit_of(with_output("-480")).notes,
              Contains(HasSubstr("stage 1 do not balance: 60 and 120 N m")));
}

// Three planets share 90 N m; 1520 rpm of a sun of 18 teeth in a held ring of 58 turn the carrier
// by 1520 18/76 = 360 rpm.
TEST(Rexs, SharesASunsTorqueAndCountsFromTheCarrier) {
  const GearUnit unit = unit_of(planetary_json());
  ASSERT_EQ(unit.stages.size(), 6U);
  EXPECT_NEAR(*unit.cases[0].torques[0], 30.0, 1e-9);
  EXPECT_NEAR(*unit.cases[0].speeds[0], 1520.0 - 360.0, 1e-9);
  EXPECT_EQ(chosen_stage(unit, ""), 0U);
  EXPECT_EQ(unit.stages[1].kind, StageKind::internal);
  try {
    stage_drawing(unit, 1, 0);
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("ring gear"));
  }
}

// Units other than REXS' own, and a centre distance that takes shifts: 92 mm instead of 90 of 20/40
// teeth of module 3 are a sum of 0.7187 by the involute's equation in SciPy.
TEST(Rexs, BecomesAStudyWithItsUnits) {
  const GearUnit unit = unit_of(two_stage_xml());
  const StageDrawing first = stage_drawing(unit, 0, 0), second = stage_drawing(unit, 1, 0);
  EXPECT_EQ(first.keys.at("centre_distance_mm").value, "92");
  EXPECT_EQ(second.keys.at("module_mm").value, "5");
  EXPECT_EQ(second.keys.at("torque_N_m").value, "120");
  EXPECT_NEAR(std::stod(first.keys.at("profile_shift").value.substr(1)), 0.7187 / 2.0, 1e-4);
  const ImportedGear study = imported_gear_study(first, "unit");
  EXPECT_THAT(study.toml, AllOf(HasSubstr("teeth = [20, 40]"), HasSubstr("ESTIMATE"),
                                HasSubstr("\nmass_kg = [")));
}

TEST(Rexs, AsksForAStageAndListsThem) {
  try {
    chosen_stage(unit_of(two_stage_xml()), "");
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("--stage 1"), HasSubstr("2: cylindrical_stage22")));
  }
}

// The example of the format's description, 19.8707 and 44.9078 to six digits.
TEST(Rexs, ReadsBase64) {
  const auto numbers = decoded_numbers("float32", "MveeQZ6hM0I");
  ASSERT_TRUE(numbers);
  EXPECT_THAT(*numbers, ElementsAre(::testing::DoubleNear(19.8707, 1e-4),
                                    ::testing::DoubleNear(44.9078, 1e-4)));
  EXPECT_FALSE(decoded_numbers("float32", "MveeQZ6hM0"));
  EXPECT_FALSE(decoded_numbers("float16", "MveeQZ6hM0I"));
}

TEST(Rexs, TellsAnUnknownUnit) {
  std::string text = two_stage_xml();
  const std::string unit = "unit=\"cm\"";
  text.replace(text.find(unit), unit.size(), "unit=\"furlong\"");
  EXPECT_THAT(unit_of(text).notes, ::testing::Contains(HasSubstr("furlong")));
}

TEST(Rexs, RefusesWhatIsHostile) {
  const auto refusal = [](const std::string& text) -> std::string {
    try {
      unit_of(text);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  const std::string deep(100000, '[');
  std::string nested;
  for (int i = 0; i < 1000; ++i) nested += "<a>";
  std::string closed = nested;
  for (int i = 0; i < 1000; ++i) closed += "</a>";
  EXPECT_THAT(refusal("<!DOCTYPE a [<!ENTITY b \"c\">]><model>&b;</model>"),
              HasSubstr("document type"));
  EXPECT_THAT(refusal("{\"model\": " + deep), HasSubstr("nested deeper"));
  EXPECT_THAT(refusal("<model>" + closed + "</model>"), HasSubstr("nested deeper"));
  EXPECT_THAT(refusal("<model>\n<relations>\n</model>"), HasSubstr("unit:3"));
  EXPECT_THAT(refusal("{\"model\": {\"components\": 3}}"), HasSubstr("no list"));
  EXPECT_THAT(refusal("<html/>"), HasSubstr("no REXS"));
  EXPECT_THAT(refusal("PK\x03\x04"), HasSubstr("ZIP"));
  EXPECT_THAT(refusal(""), HasSubstr("empty"));
  EXPECT_THAT(refusal("<model><components>\n<component id=\"1\"/>\n<component id=\"1\"/>"
                      "</components></model>"),
              HasSubstr("unit:3: a second component"));
}

}  // namespace
}  // namespace gearsweep::testing
