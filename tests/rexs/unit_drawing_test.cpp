// Whole gear units: models with a drawing for each mesh, by closed forms and by the studies of
// their stages; the same unit in any of the ways that a file may have it; what cannot be placed.
#include "rexs/unit_drawing.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "model/error.hpp"
#include "rexs/stage_choice.hpp"
#include "rexs/unit_text.hpp"
#include "study/imported_gear.hpp"
#include "study/study.hpp"

namespace gearsweep::testing {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;

const double kPi = std::numbers::pi;

GearUnit read_unit(const std::string& text) { return gear_unit_of(read_rexs(text, "unit.rexs")); }
GearUnit read_unit(const TextUnit& text) { return read_unit(xml_of(text)); }

ImportedGear whole(const GearUnit& unit) {
  return imported_unit_study(unit_drawing(unit, ""), "unit.rexs");
}
Study study_of(const ImportedGear& imported) { return read_study(imported.toml, "unit.toml"); }

double value_of(const Study& study, const std::string& name) {
  const int index = study.model->find_parameter(name);
  EXPECT_GE(index, 0) << name;
  return study.setting.parameters[static_cast<std::size_t>(index)];
}

std::string refusal(const GearUnit& unit) {
  try {
    whole(unit);
  } catch (const InputError& error) {
    return error.what();
  }
  return "it is a study";
}

// What a key of a drawing has, "[1, 2]" as two numbers.
std::pair<double, double> pair_in(const StageDrawing& drawing, const std::string& key) {
  const std::string& text = drawing.keys.at(key).value;
  return {std::stod(text.substr(1)), std::stod(text.substr(text.find(',') + 1))};
}

// Contact ratios and mesh stiffness are those of each stage alone, and the middle shaft's inertia
// is that of the whole shaft, which the stages have, both of them.
TEST(WholeUnit, HasWhatTheStudiesOfItsStagesHave) {
  const GearUnit unit = read_unit(two_stages().unit);
  const Study study = study_of(whole(unit));
  const UnitDrawing drawing = unit_drawing(unit, "");
  const char* const names[] = {"_first", "_second"};
  for (std::size_t i = 0; i < 2; ++i) {
    const Study own = study_of(imported_gear_study(stage_drawing(unit, i, 0), "stage"));
    EXPECT_EQ(value_of(study, std::string("eps") + names[i]), value_of(own, "eps"));
    EXPECT_NEAR(value_of(study, std::string("k0") + names[i]) / own.scales.k0, 1.0, 1e-12);
    EXPECT_EQ(value_of(study, std::string("teeth_ratio") + names[i]), value_of(own, "teeth_ratio"));
  }
  const auto first = pair_in(drawing.drawings[0].second, "inertia_kg_mm2");
  const auto second = pair_in(drawing.drawings[1].second, "inertia_kg_mm2");
  const StageDrawing of_first = stage_drawing(unit, 0, 0), of_second = stage_drawing(unit, 1, 0);
  EXPECT_NEAR(first.first, pair_in(of_first, "inertia_kg_mm2").first, 1e-3);
  EXPECT_NEAR(second.second / pair_in(of_second, "inertia_kg_mm2").second, 1.0, 1e-5);
  EXPECT_NEAR((first.second + second.first) / pair_in(of_first, "inertia_kg_mm2").second, 1.0,
              1e-5);
}

// The torque of the middle shaft is 50 N m times 41/20, and acts on the base circle of the second
// pinion, 18 4/2 cos(20 deg) mm; the second mesh has 18/41 of the first one's frequency, and the
// torsional stiffness of 80 mm of a steel shaft of 40 mm is G pi d^4/(32 L).
TEST(WholeUnit, CarriesTorqueAndSpeedThroughItsRatios) {
  const GearUnit unit = read_unit(two_stages().unit);
  const Study study = study_of(whole(unit));
  const double radius = 18.0 * 4.0 / 2.0 * std::cos(20.0 * kPi / 180.0) * 1e-3;
  const double force = value_of(study, "F2") * study.scales.k0 * study.scales.b_n;
  EXPECT_NEAR(force / (50.0 * 41.0 / 20.0 / radius), 1.0, 1e-9);
  EXPECT_NEAR(value_of(study, "frequency_ratio_second"), 18.0 / 41.0, 1e-12);
  EXPECT_NEAR(*unit.cases[0].speeds[1], 1230.0 * 20.0 / 41.0, 1e-9);
  const double twist = 8.1e10 * kPi * std::pow(0.04, 4) / 32.0 / 0.08;
  EXPECT_NEAR(value_of(study, "k_shaft") / twist, 1.0, 1e-5);
  // The axis is in rpm of the first pinion: omega is its mesh frequency over sqrt(k0/me).
  ASSERT_EQ(study.axes[0].name, "pinion_speed_rpm_first");
  ASSERT_EQ(study.axes[0].columns[0].name, "omega");
  EXPECT_NEAR(study.axes[0].columns[0].values[0] * value_of(study, "varpi_first") /
                  (study.axes[0].values[0] / 60.0 * 2.0 * kPi * 20.0),
              1.0, 1e-12);
}

TEST(WholeUnit, IsTheSameInAnyOrderFormatAndVersion) {
  const TextUnit unit = [] {
    UnitBuilder built = two_stages();
    built.drives("50", "20", true);
    built.drives("50", "21", false);
    return built.unit;
  }();
  const std::string text = whole(read_unit(unit)).toml;
  EXPECT_EQ(whole(read_unit(json_of(unit))).toml, text);
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const TextUnit other = shuffled(unit, seed);
    EXPECT_EQ(study_of(whole(read_unit(other))).setting.parameters,
              study_of(whole(read_unit(unit))).setting.parameters)
        << seed;
    EXPECT_EQ(whole(read_unit(json_of(other))).toml, whole(read_unit(other)).toml) << seed;
  }
  for (const char* version : {"1.0", "1.1", "1.2", "1.3", "1.5", "1.6", "1.7"}) {
    const TextUnit other = with_older_names(unit, version);
    EXPECT_EQ(study_of(whole(read_unit(other))).setting.parameters,
              study_of(whole(read_unit(unit))).setting.parameters)
        << version;
  }
  for (const TextUnit& one : {unit, planetary_set(3).unit}) {
    EXPECT_EQ(whole(read_unit(with_newer_relations(one))).toml, whole(read_unit(one)).toml);
  }
  TextUnit next = unit;
  next.version = "2.0";
  EXPECT_THAT(read_unit(next).notes, Contains(HasSubstr("version '2.0'")));
}

// Bodies have six digits in the text.
TEST(WholeUnit, IsTheSameInOtherUnits) {
  for (const TextUnit& unit : {two_stages().unit, planetary_set(3).unit}) {
    const Study study = study_of(whole(read_unit(unit)));
    const Study other = study_of(whole(read_unit(in_other_units(unit))));
    for (std::size_t i = 0; i < study.setting.parameters.size(); ++i) {
      EXPECT_NEAR(other.setting.parameters[i], study.setting.parameters[i],
                  2e-5 * std::fabs(study.setting.parameters[i]))
          << study.model->parameters[i].name;
    }
  }
}

// Which end drives is what the file says; without it the faster one does.
TEST(WholeUnit, KnowsWhichShaftDrives) {
  EXPECT_THAT(whole(read_unit(two_stages().unit)).notes,
              Contains(HasSubstr("does not say which shaft drives: shaft 2")));
  UnitBuilder built = two_stages();
  built.drives("51", "23", true);
  built.drives("51", "22", false);
  const ImportedGear imported = whole(read_unit(built.unit));
  const Study study = study_of(imported);
  EXPECT_EQ(value_of(study, "zp_first"), 45.0);
  EXPECT_EQ(value_of(study, "zp_second"), 41.0);
  EXPECT_THAT(imported.toml, HasSubstr("teeth = [45, 18]"));
  // 50 N m on the slow shaft's end are what they are at the fast one, times both ratios.
  EXPECT_NEAR(std::stod(imported.toml.substr(imported.toml.find("\ntorque_N_m = ") + 14)),
              50.0 * 41.0 / 20.0 * 45.0 / 18.0, 1e-3);
}

TEST(WholeUnit, HasARigidShaftWhereTheFileHasNoBodyOfIt) {
  UnitBuilder built = two_stages();
  built.unit.set("913", "length", "mm", "90");
  const ImportedGear imported = whole(read_unit(built.unit));
  EXPECT_THAT(imported.toml, HasSubstr("shaft = \"rigid\""));
  EXPECT_THAT(imported.notes, Contains(HasSubstr("is rigid here")));
}

TEST(WholeUnit, TellsWhatCannotBePlacedAndWhatToDo) {
  EXPECT_THAT(refusal(read_unit(three_stages().unit)),
              AllOf(HasSubstr("it has 3 stages"), HasSubstr("1: cylindrical_stage 50, 20/41 teeth"),
                    HasSubstr("3: cylindrical_stage 52, 23/37 teeth"), HasSubstr("--stage 1")));
  UnitBuilder idler = two_stages();
  idler.unit.relations.erase(std::ranges::find_if(
      idler.unit.relations,
      [](const TextRelation& one) { return one.type == "stage" && one.refs[0].second == "51"; }));
  idler.relate("stage", {{"stage", "51"}, {"gear_1", "21"}, {"gear_2", "23"}});
  idler.unit.set("23", "normal_module", "mm", "3");
  EXPECT_THAT(refusal(read_unit(idler.unit)), HasSubstr("it is an idler"));
  UnitBuilder shift = two_stages();
  shift.unit.set("51", "center_distance", "mm", "126");
  for (TextRelation& one : shift.unit.relations) {
    if (one.type == "assembly" && one.refs[1].second == "23") one.refs[0].second = "2";
  }
  EXPECT_THAT(refusal(read_unit(shift.unit)), HasSubstr("same two shafts"));
  UnitBuilder apart = two_stages();
  apart.shaft("5", 91.5, 40.0, 100.0);
  for (TextRelation& one : apart.unit.relations) {
    if (one.type == "assembly" && one.refs[1].second == "22") one.refs[0].second = "5";
  }
  EXPECT_THAT(refusal(read_unit(apart.unit)), HasSubstr("share no shaft"));
  UnitBuilder bevel = two_stages();
  bevel.unit.at("51").type = "bevel_stage";
  EXPECT_THAT(refusal(read_unit(bevel.unit)), HasSubstr("no cylindrical gears"));
  EXPECT_THAT(refusal(read_unit(planetary_set(4).unit)), HasSubstr("it has 4 planets"));
  UnitBuilder loose = planetary_set(3);
  std::erase_if(loose.unit.relations, [](const TextRelation& one) { return one.type == "side"; });
  EXPECT_THAT(refusal(read_unit(loose.unit)), HasSubstr("holds its ring"));
  UnitBuilder both = planetary_set(3);
  both.shaft("5", 91.5, 40.0, 100.0);
  both.gear("24", "4", 20, 3.0, 0.0, 50.0);
  both.gear("25", "5", 41, 3.0, 0.0, 50.0);
  both.stage("90", "24", "25", 91.5);
  EXPECT_THAT(refusal(read_unit(both.unit)), HasSubstr("others beside it"));
}

// Another maker's file: SI units and older ones, blanks for units, no names of versions after 1.0,
// other order; the second stage lacks teeth and modules, and its centre distance has a unit that
// nobody knows. All that is missing is told at once, and the other stages are studies.
TEST(WholeUnit, OfAnotherMakerTellsAllThatIsMissing) {
  UnitBuilder built = three_stages();
  for (const char* gear : {"22", "23"}) {
    std::erase_if(built.unit.at(gear).attributes, [](const TextAttribute& one) {
      return one.id == "normal_module" || one.id == "number_of_teeth";
    });
  }
  std::erase_if(built.unit.at("21").attributes,
                [](const TextAttribute& one) { return one.id == "face_width"; });
  TextUnit unit = with_older_names(in_other_units(shuffled(built.unit, 7)), "1.0");
  unit.set("51", "center_distance", "furlong", "0.6");
  std::erase_if(unit.at("952").attributes,
                [](const TextAttribute& one) { return one.id == "torque_around_u_axis"; });
  unit.set("952", "power", "PS",
           fmt::format("{:.12g}", 50.0 * 1230.0 * kPi / 30000.0 / 0.73549875));
  const GearUnit read = read_unit(json_of(unit));
  EXPECT_THAT(read.notes, Contains(AllOf(HasSubstr("'furlong', which is none of mm, m, cm"))));
  const std::size_t second = static_cast<std::size_t>(
      std::ranges::find(read.stages, "cylindrical_stage 51", &UnitStage::name) -
      read.stages.begin());
  EXPECT_THAT(read.stages[second].refusal,
              AllOf(HasSubstr("cylindrical_gear 22 has no number_of_teeth"),
                    HasSubstr("cylindrical_gear 23 has no number_of_teeth"),
                    HasSubstr("no normal_module")));
  const StageDrawing first = stage_drawing(read, chosen_stage(read, "cylindrical_stage 50"), 0);
  EXPECT_NEAR(std::stod(first.keys.at("torque_N_m").value), 50.0, 1e-3);
  EXPECT_NEAR(first.fastest, 1230.0, 1e-6);
  EXPECT_EQ(first.keys.at("face_width_mm").value, "30");
  EXPECT_THAT(first.keys.at("face_width_mm").origin, HasSubstr("ESTIMATE"));
  // No ratio of the second stage, so no torque and no speed of the third.
  const StageDrawing third = stage_drawing(read, chosen_stage(read, "cylindrical_stage 52"), 0);
  EXPECT_THAT(third.notes, AllOf(Contains(HasSubstr("the torque on this mesh follows from no")),
                                 Contains(HasSubstr("the speed of this mesh follows from no")),
                                 Contains(HasSubstr("neither center_distance")).Times(0)));
  EXPECT_EQ(study_of(imported_gear_study(third, "unit")).axes[0].name, "pinion_speed_rpm");
}

// 41 and 18 teeth on the middle shaft have no common divisor; 40 and 20 meet in two phases.
TEST(WholeUnit, TellsHowFarThePhaseOfItsMeshesCounts) {
  const ImportedGear coprime = whole(read_unit(two_stages().unit));
  EXPECT_THAT(coprime.notes, Contains(AllOf(HasSubstr("shift, is 0 here"),
                                            HasSubstr("differ by 1/41 make the same motion"))));
  EXPECT_EQ(value_of(study_of(coprime), "shift"), 0.0);
  UnitBuilder even = two_stages();
  even.unit.set("21", "number_of_teeth", "none", "40");
  even.unit.set("22", "number_of_teeth", "none", "20");
  even.unit.set("50", "center_distance", "mm", "90");
  even.unit.set("51", "center_distance", "mm", "130");
  EXPECT_THAT(whole(read_unit(even.unit)).notes, Contains(HasSubstr("sweep it from 0 to 1/2")));
}

// Each load case's torque and speed, through the ratios of the unit.
TEST(WholeUnit, HasItsLoadCasesAsALoadSpectrum) {
  RexsDocument document = read_rexs(xml_of(two_stages().unit), "unit.rexs");
  const auto one_case = [&](const std::string& id, const char* torque, const char* speed,
                            const char* share) {
    TextUnit unit;
    if (*share != '\0') {
      unit.components.push_back({"1", "gear_unit", "", {{"load_duration_fraction", "%", share}}});
    }
    unit.components.push_back({"2", "shaft", "", {{"rotational_speed", "1 / min", speed}}});
    unit.components.push_back(
        {"952", "external_load", "", {{"torque_around_u_axis", "N m", torque}}});
    document.load_cases.push_back({id, read_rexs(xml_of(unit), "case").components});
  };
  one_case("1", "40", "820", "25");
  one_case("2", "-60", "410", "75");
  const GearUnit unit = gear_unit_of(document);
  const Study study = study_of(
      imported_gear_study(stage_drawing(unit, 1, 0), "unit.rexs", ImportedPoints::load_spectrum));
  ASSERT_TRUE(study.spectrum.has_value());
  EXPECT_THAT(study.spectrum->shares, ::testing::ElementsAre(0.25, 0.75));
  const auto column = [&](const Study& of, const std::string& name) {
    return of.axes[0].find_column(name)->values;
  };
  EXPECT_NEAR(column(study, "torque_N_m")[0], 40.0 * 41.0 / 20.0, 1e-6);
  EXPECT_NEAR(column(study, "torque_N_m")[1], 60.0 * 41.0 / 20.0, 1e-6);
  EXPECT_NEAR(column(study, "pinion_speed_rpm")[1], 200.0, 1e-6);
  const Study both = study_of(
      imported_unit_study(unit_drawing(unit, ""), "unit.rexs", ImportedPoints::load_spectrum));
  EXPECT_EQ(column(both, "torque_N_m_first")[1], 60.0);
  EXPECT_EQ(column(both, "pinion_speed_rpm_first")[0], 820.0);
  one_case("3", "10", "0", "");
  const StageDrawing drawing = stage_drawing(gear_unit_of(document), 0, 0);
  try {
    imported_gear_study(drawing, "unit.rexs", ImportedPoints::load_spectrum);
    ADD_FAILURE() << "a case without a share is a spectrum";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("load case 3 has not a speed"),
                                    HasSubstr("nor a share of the time")));
  }
}

// Each stage of a unit of three is a study of its own; its torque and speed follow from the ratios.
TEST(WholeUnit, OfThreeStagesHasAStudyOfEach) {
  const GearUnit unit = read_unit(json_of(shuffled(three_stages().unit, 3)));
  const double turns[] = {1230.0, 600.0, 240.0}, torques[] = {50.0, 102.5, 256.25};
  const int teeth[] = {20, 18, 23};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t stage = chosen_stage(unit, fmt::format("cylindrical_stage 5{}", i));
    const StageDrawing drawing = stage_drawing(unit, stage, 0);
    EXPECT_EQ(drawing.teeth[0], teeth[i]);
    EXPECT_NEAR(std::stod(drawing.keys.at("torque_N_m").value), torques[i], 1e-3);
    EXPECT_NEAR(drawing.fastest, turns[i], 1e-9);
    EXPECT_EQ(study_of(imported_gear_study(drawing, "unit")).axes[0].name, "pinion_speed_rpm");
  }
}

// A sun of 24 in a held ring of 60 turns the carrier at 24/84 of its speed; its torque is on three
// meshes. The carrier: a disc of 40 x 60 mm, and pins of 12 x 50 mm on a circle of 42 mm. Contact
// ratios of the ring by its tips, a module inside of its reference circle.
TEST(WholeUnit, OfAPlanetaryStage) {
  const ImportedGear imported = whole(read_unit(planetary_set(3).unit));
  const Study study = study_of(imported);
  EXPECT_EQ(value_of(study, "z_ring"), 60.0);
  const double alpha = 20.0 * kPi / 180.0, pitch = 2.0 * kPi * std::cos(alpha);
  const double force = value_of(study, "F1_sun") * study.scales.k0 * study.scales.b_n;
  EXPECT_NEAR(force / (90.0 / (24.0e-3 * std::cos(alpha))), 1.0, 1e-9);
  EXPECT_NEAR(value_of(study, "F_planet") / value_of(study, "F1_sun"), 1.0 / 3.0, 1e-12);
  const double density = 7.85e-6;
  const double disc = density * kPi * 20.0 * 20.0 * 60.0, pin = density * kPi * 6.0 * 6.0 * 50.0;
  EXPECT_NEAR(value_of(study, "mass_carrier") / (disc + 3.0 * pin), 1.0, 1e-6);
  const double inertia = disc * 200.0 + 3.0 * pin * (18.0 + 42.0 * 42.0);
  EXPECT_NEAR(value_of(study, "inertia_carrier") / (1e-6 * inertia), 1.0, 1e-6);
  const double base = 18.0 * std::cos(alpha), ring = 60.0 * std::cos(alpha);
  const double after = std::sqrt(20.0 * 20.0 - base * base) - base * std::tan(alpha);
  const double before = ring * std::tan(alpha) - std::sqrt(58.0 * 58.0 - ring * ring);
  EXPECT_NEAR(value_of(study, "eps_ring"), (after + before) / pitch, 1e-9);
  EXPECT_NEAR(value_of(study, "approach_ring"), before / (after + before), 1e-9);
  EXPECT_THAT(imported.toml, HasSubstr("pinion_speed_rpm = 714.286"));
}

// Whatever is missing, there is a study or a message that names the file. The equations of a
// planetary stage take long, so of these only the drawing is made.
TEST(WholeUnit, WithoutAnyOneAttributeIsAStudyOrARefusal) {
  const auto drawn = [](const GearUnit& unit) -> std::string {
    try {
      return unit_drawing(unit, "").model;
    } catch (const InputError& error) {
      return error.what();
    }
  };
  const TextUnit two = two_stages().unit;
  for (const TextUnit& unit : {two, planetary_set(3).unit}) {
    const bool is_two = unit.components.size() == two.components.size();
    for (std::size_t i = 0; i < unit.components.size(); ++i) {
      for (std::size_t k = 0; k < unit.components[i].attributes.size(); ++k) {
        TextUnit other = unit;
        const auto at = static_cast<std::ptrdiff_t>(k);
        other.components[i].attributes.erase(other.components[i].attributes.begin() + at);
        const std::string told = is_two ? refusal(read_unit(other)) : drawn(read_unit(other));
        EXPECT_THAT(told, ::testing::AnyOf("it is a study", "planetary", HasSubstr("unit.rexs: ")))
            << unit.components[i].name << " without " << unit.components[i].attributes[k].id;
      }
    }
  }
}

}  // namespace
}  // namespace gearsweep::testing
