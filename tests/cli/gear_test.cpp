// gearsweep gear: what follows from a drawing, and the study of a new one.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "cli/page.hpp"
#include "rexs/unit_text.hpp"
#include "rexs/units.hpp"
#include "support/folder.hpp"
#include "support/process.hpp"

namespace gearsweep::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

TEST(GearCommand, BeginsAStudyThatRuns) {
  const Folder folder;
  const Outcome begun = gearsweep(folder, "gear new 19/61 --module 2.5 --torque 60 -o mine.toml");
  ASSERT_EQ(begun.status, 0) << begun.err;
  EXPECT_THAT(begun.err, HasSubstr("put your own numbers at ESTIMATE"));
  EXPECT_EQ(gearsweep(folder, "run mine.toml --dry-run").status, 0);
  const Outcome again = gearsweep(folder, "gear new 19/61 --module 2.5 -o mine.toml");
  EXPECT_EQ(again.status, 2);
  EXPECT_THAT(again.err, HasSubstr("is there"));
}

// What each of the arrangements is written with, and its first drawing's pinion.
class NewArrangement : public ::testing::TestWithParam<std::pair<const char*, const char*>> {};

TEST_P(NewArrangement, RunsAsWritten) {
  const auto& [command, mesh] = GetParam();
  const Folder folder;
  const Outcome begun =
      gearsweep(folder, std::string("gear new ") + command + " --module 2.5 -o mine.toml");
  ASSERT_EQ(begun.status, 0) << begun.err;
  EXPECT_THAT(begun.err, HasSubstr("put your own numbers at ESTIMATE"));
  const Outcome told = gearsweep(folder, "gear mine.toml");
  EXPECT_EQ(told.status, 0) << told.err;
  EXPECT_THAT(told.out, AllOf(HasSubstr("contact ratio"), HasSubstr(mesh)));
  const Outcome run = gearsweep(folder,
                                "run mine.toml -o mine.nc --set 'axes.0.count=2' --set "
                                "integrate.settle=4 --set integrate.record=2");
  EXPECT_EQ(run.status, 0) << run.err;
}

INSTANTIATE_TEST_SUITE_P(Each, NewArrangement,
                         ::testing::Values(std::pair{"19/33/61", "damping"},
                                           std::pair{"20/41 18/45", "1 of second"},
                                           std::pair{"28/35/98 --planetary", "damping"}));

TEST(GearCommand, GivesStagesTheirOwnNumbers) {
  const Folder folder;
  const Outcome told =
      gearsweep(folder, "gear new 20/41 18/45 --module 2.5,4 --width 25,40 --helix 12,0");
  ASSERT_EQ(told.status, 0) << told.err;
  EXPECT_THAT(told.out, AllOf(HasSubstr("module_mm = 2.5\n"), HasSubstr("module_mm = 4\n"),
                              HasSubstr("face_width_mm = 25\n"), HasSubstr("face_width_mm = 40\n"),
                              HasSubstr("helix_angle_deg = 12\n")));
}

TEST(GearCommand, TeachesHowGearsAreGiven) {
  const Folder folder;
  const auto refusal = [&](const std::string& command) {
    const Outcome refused = gearsweep(folder, "gear new " + command);
    EXPECT_EQ(refused.status, 2) << command;
    return refused.err;
  };
  EXPECT_THAT(refusal("19-61 --module 2"),
              AllOf(HasSubstr("'19-61' is no number of teeth"), HasSubstr("19/61"),
                    HasSubstr("20/41 18/45"), HasSubstr("28/35/98 --planetary")));
  EXPECT_THAT(refusal("19/ --module 2"), HasSubstr("'' is no number of teeth"));
  EXPECT_THAT(refusal("19 --module 2"), HasSubstr("one number of teeth makes no mesh"));
  EXPECT_THAT(refusal("19/33/40/61 --module 2"), HasSubstr("rows of more than three gears"));
  EXPECT_THAT(refusal("19/33 17/20 18/45 --module 2"), HasSubstr("more than two stages"));
  EXPECT_THAT(refusal("19/33/61 18/45 --module 2"), HasSubstr("a stage is a pair of gears"));
  EXPECT_THAT(refusal("28/35 --planetary --module 2"), HasSubstr("a sun, planets and a ring"));
  EXPECT_THAT(refusal("28/35/98 --planetary --module 2,3"), HasSubstr("have one number"));
  EXPECT_THAT(refusal("19/61 --module 2,3"), HasSubstr("have one number"));
  EXPECT_THAT(refusal("20/41 18/45 --module 2,3,4"), HasSubstr("two stages have two numbers"));
  EXPECT_THAT(refusal("19/61 --module -2"), HasSubstr("not a number greater than 0"));
  EXPECT_THAT(refusal("19/61 --module 2 --helix 60"), HasSubstr("not a number from 0 to 45"));
  // Three numbers in a row that would make a planetary set.
  EXPECT_THAT(gearsweep(folder, "gear new 28/35/98 --module 2").err, HasSubstr("--planetary"));
}

TEST(GearCommand, ImportsAStageThatRuns) {
  const Folder folder;
  folder.write("unit.rexs", two_stage_xml());
  const Outcome made = gearsweep(folder, "gear import unit.rexs --stage 2 -o second.toml");
  ASSERT_EQ(made.status, 0) << made.err;
  EXPECT_THAT(made.err, HasSubstr("note: "));
  EXPECT_EQ(gearsweep(folder, "gear second.toml").status, 0);
  EXPECT_EQ(gearsweep(folder, "run second.toml --dry-run").status, 0);
  const Outcome asked = gearsweep(folder, "gear import unit.rexs");
  EXPECT_EQ(asked.status, 2);
  EXPECT_THAT(asked.err, HasSubstr("choose a stage"));
  const auto json = nlohmann::json::parse(gearsweep(folder, "gear import unit.rexs --json").out);
  EXPECT_EQ(json.at("stages")[1].at("gears")[0].at("teeth"), 25.0);
  EXPECT_EQ(json.at("load_cases")[0].at("first_gear_torque_N_m")[1], 120.0);
}

TEST(GearCommand, ImportsAWholeUnitThatRuns) {
  const Folder folder;
  folder.write("unit.rexs", xml_of(two_stages().unit));
  folder.write("three.rexsj", json_of(three_stages().unit));
  const Outcome made = gearsweep(folder, "gear import unit.rexs --all -o unit.toml");
  ASSERT_EQ(made.status, 0) << made.err;
  EXPECT_THAT(made.err, HasSubstr("a study of the whole unit"));
  EXPECT_EQ(gearsweep(folder, "gear unit.toml").status, 0);
  const Outcome run = gearsweep(folder, "run unit.toml -o unit.nc --set 'axes.0.count=3'");
  EXPECT_EQ(run.status, 0) << run.err;
  const Outcome refused = gearsweep(folder, "gear import three.rexsj --all");
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, AllOf(HasSubstr("it has 3 stages"), HasSubstr("--stage 1")));
  EXPECT_EQ(gearsweep(folder, "gear import unit.rexs --all --stage 1").status, 2);
}

// 40 and 20 teeth on the middle shaft: after one more tooth of the gear the pinion is half a pitch
// further on, so that half a mesh period of the phase is the same motion, and a quarter is not.
TEST(GearCommand, ImportsAUnitWhosePhaseCountsByThePitchThatItsTeethShare) {
  UnitBuilder built = two_stages();
  built.unit.set("21", "number_of_teeth", "none", "40");
  built.unit.set("22", "number_of_teeth", "none", "20");
  built.unit.set("50", "center_distance", "mm", "90");
  built.unit.set("51", "center_distance", "mm", "130");
  const Folder folder;
  folder.write("unit.rexs", xml_of(built.unit));
  ASSERT_EQ(gearsweep(folder, "gear import unit.rexs --all -o unit.toml").status, 0);
  const auto largest_force = [&](const std::string& shift) {
    const Outcome run = gearsweep(
        folder,
        "run unit.toml -o unit.nc --set axes.0.from=3500 --set axes.0.to=4000 --set axes.0.count=2 "
        "--set parameters.shift=" +
            shift);
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(gearsweep(folder, "export unit.nc -q dmf1_max -o unit.csv").status, 0);
    const std::string csv = read_all(folder / "unit.csv");
    return std::stod(csv.substr(csv.rfind(',') + 1));
  };
  const double own = largest_force("0");
  EXPECT_NEAR(largest_force("0.5") / own, 1.0, 1e-6);
  EXPECT_GT(std::abs(largest_force("0.25") / own - 1.0), 1e-4);
}

// Two discs on very stiff bearings that roll on each other through one spring: its frequency is
// sqrt(k0/me), and at the critical speed the teeth meet so often.
TEST(GearCommand, TellsCriticalSpeeds) {
  const Folder folder;
  folder.write("pair.toml",
               "[gear]\nteeth = [20, 40]\nmodule_mm = 3\ninertia_kg_mm2 = [300, 5000]\n"
               "mass_kg = 1.0\nbearing_stiffness_N_per_mm = 1e11\nbearing_damping_N_s_per_mm = 0\n"
               "mesh_damping_ratio = 0.01\nhalf_backlash_mm = 0.05\n"
               "mesh_stiffness_N_per_m = 3e8\ntorque_N_m = 50\ntransmission_error_um = 5\n");
  const Outcome told = gearsweep(folder, "gear pair.toml --json");
  ASSERT_EQ(told.status, 0) << told.err;
  const auto json = nlohmann::json::parse(told.out);
  const double pinion = 30.0 * std::cos(20.0 * std::numbers::pi / 180.0), gear = 2.0 * pinion;
  const double me = 1.0 / (pinion * pinion / 300.0 + gear * gear / 5000.0);
  const double hertz = std::sqrt(3e8 / me) / (2.0 * std::numbers::pi);
  const auto& mode = json.at("modes")[0];
  EXPECT_NEAR(mode.at("frequency_Hz").get<double>() / hertz, 1.0, 3e-3);
  EXPECT_NEAR(mode.at("damping").get<double>(), 0.01, 1e-4);
  EXPECT_NEAR(mode.at("critical_rpm")[1].get<double>() / (60.0 * hertz / 20.0 / 2.0), 1.0, 3e-3);
  EXPECT_THAT(gearsweep(folder, "gear pair.toml").out, HasSubstr("contact ratio"));
}

TEST(GearCommand, SaysWhatIsWrong) {
  const Folder folder;
  const auto refusal = [&](const std::string& command) {
    const Outcome refused = gearsweep(folder, command);
    EXPECT_EQ(refused.status, 2) << command;
    return refused.err;
  };
  EXPECT_THAT(refusal("gear"), HasSubstr("gearsweep gear new 19/61"));
  EXPECT_THAT(refusal("gear coarse-map"), HasSubstr("has no [gear] table"));
  EXPECT_THAT(refusal("gear new 19-61 --module 2"), HasSubstr("is no number of teeth"));
  EXPECT_THAT(refusal("gear new 19/61"), HasSubstr("--module"));
  EXPECT_THAT(refusal("gear new 2/61 --module 2"), HasSubstr("teeth"));
}

// The second pinion has 18 teeth on the shaft of a gear of 41: its mesh meets a natural frequency
// at a speed of the first pinion that is higher by 41/18.
TEST(GearCommand, CountsTheOrdersOfBothMeshes) {
  const Folder folder;
  const std::string pair =
      "module_mm = 3\ninertia_kg_mm2 = [400, 5000]\nhalf_backlash_mm = 0.05\n"
      "mesh_stiffness_N_per_m = 2e8\nmesh_damping_ratio = 0.05\ntransmission_error_um = 5\n";
  folder.write("stages.toml", "[model]\nname = 'two_stages'\n[gear.first]\nteeth = [20, 41]\n" +
                                  pair + "torque_N_m = 40\n[gear.second]\nteeth = [18, 45]\n" +
                                  pair);
  const Outcome told = gearsweep(folder, "gear stages.toml --json");
  ASSERT_EQ(told.status, 0) << told.err;
  const nlohmann::json modes = nlohmann::json::parse(told.out)["modes"];
  ASSERT_EQ(modes.size(), 2U);
  for (const nlohmann::json& mode : modes) {
    for (std::size_t order = 0; order < 3; ++order) {
      EXPECT_NEAR(mode["critical_rpm_second"][order].get<double>(),
                  mode["critical_rpm"][order].get<double>() * 41.0 / 18.0, 1e-6);
    }
  }
  EXPECT_THAT(gearsweep(folder, "gear stages.toml").out,
              AllOf(HasSubstr("1 of first"), HasSubstr("3 of second")));
}

}  // namespace
}  // namespace gearsweep::testing
