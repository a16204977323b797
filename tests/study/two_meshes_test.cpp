// A model of two meshes, each with its own drawing: [gear.first] and [gear.second].
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "gear/dynamic_factor.hpp"
#include "model/error.hpp"
#include "study/refusal.hpp"
#include "study/study.hpp"

namespace gearsweep::testing {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

// The second mesh has no load and no bearings.
const char* const kModel =
    "[model]\ntext = '''\n[model]\nname = \"train\"\n"
    "[drawings]\nfirst = \"input stage\"\nsecond = \"output stage\"\n"
    "[states]\nx = {}\nv = {}\ny = {}\nw = {}\n"
    "[parameters]\nomega = 0.7\nk0_first = 1.0\nk0_second = 1.0\nb_n_first = 1.0\n"
    "b_n_second = 1.0\nvarpi_second = 1.0\neps_first = 1.5\neps_second = 1.5\n"
    "F1_first = 0.1\nm1_first = 1.0\nm2_first = 1.0\ne0_first = [0.1, 0.0]\n"
    "e0_phase_first = [0.0, 0.0]\ne0_second = 0.1\nzeta_first = 0.05\nzeta_second = 0.05\n"
    "[options]\nerror_first = { choices = [\"sine\", \"series\"] }\n"
    "[curves]\nmeasured_stiffness_second = \"of the output stage, in its k0\"\n"
    "[equations]\nx = \"v\"\nv = \"F1_first - zeta_first*v - x*m1_first/m2_first/eps_first\"\n"
    "y = \"w\"\nw = \"x*k0_first*b_n_first/k0_second/b_n_second/varpi_second - zeta_second*w "
    "- y/eps_second*if(measured_stiffness_second.given, measured_stiffness_second(phase), 1) "
    "+ e0_second*sin(phase) + e0_first*sin(phase + e0_phase_first) "
    "+ if(error_first.series, e0_first_2*sin(2*phase + e0_phase_first_2), 0)\"\n"
    "[forcing]\nperiod = \"2*pi/omega\"\n'''\n";
const std::string kPair =
    "module_mm = 4\ninertia_kg_mm2 = [600, 9000]\nhalf_backlash_mm = 0.04\n"
    "mesh_damping_N_s_per_mm = 0.5\n";
const std::string kFirst = "teeth = [20, 40]\n" + kPair +
                           "mesh_stiffness_N_per_m = 3e8\ntorque_N_m = 150\nmass_kg = [0.9, 3.2]\n"
                           "transmission_error_um = [6, 2]\n";
const std::string kSecond =
    "teeth = [24, 30]\n" + kPair + "transmission_error_um = 3\nstiffness_file = 'k.csv'\n";
const std::string kMeasuredSecond = "'k.csv' = '''\n0 4e8\n2 5e8\n4 3e8\n'''\n";
const std::string kOmega = "[[axes]]\nname = 'omega'\nvalues = [0.5, 0.7]\n";

std::string drawings(const std::string& of_first = "", const std::string& of_second = "") {
  return kModel + ("[gear.first]\n" + kFirst) + of_first + "[gear.second]\n" + kSecond + of_second +
         "[gear.second.tables]\n" + kMeasuredSecond;
}

double parameter_of(const Study& study, const std::string& name) {
  return study.setting.parameters[static_cast<std::size_t>(study.model->find_parameter(name))];
}

// Its placeholders would pass for a gear.
TEST(TwoMeshes, OneWithoutItsDrawingIsTold) {
  const auto told = [](const std::string& text) { return read_study(text, "s.toml").notices; };
  const std::string first = kModel + ("[gear.first]\n" + kFirst) + kOmega;
  EXPECT_THAT(told(first), Contains(HasSubstr("no [gear.second]")));
  EXPECT_THAT(told(drawings() + kOmega), Not(Contains(HasSubstr("the study has no [gear."))));
  EXPECT_THAT(told(kModel + kOmega), Not(Contains(HasSubstr("the study has no [gear."))));
}

TEST(TwoMeshes, HaveWhatEachDrawingGivesToGear5) {
  const Study study = read_study(drawings() + kOmega, "s.toml");
  const std::string bearings = "bearing_stiffness_N_per_mm = 1e5\nbearing_damping_N_s_per_mm = 1\n";
  const Study first = read_study("[gear]\n" + kFirst + bearings + kOmega, "first.toml");
  const Study second = read_study("[gear]\n" + kSecond + "torque_N_m = 9\nmass_kg = 1\n" +
                                      bearings + "[gear.tables]\n" + kMeasuredSecond + kOmega,
                                  "second.toml");
  for (const char* name : {"eps", "F1", "m1", "m2", "e0", "e0_2", "zeta"}) {
    const std::string own =
        std::string(name) == "e0_2" ? "e0_first_2" : name + std::string("_first");
    EXPECT_EQ(parameter_of(study, own), parameter_of(first, name)) << name;
  }
  for (const char* name : {"eps", "e0", "zeta"}) {
    EXPECT_EQ(parameter_of(study, name + std::string("_second")), parameter_of(second, name));
  }
  EXPECT_EQ(parameter_of(study, "k0_first"), first.scales.k0);
  EXPECT_EQ(parameter_of(study, "k0_second"), second.scales.k0);
  EXPECT_EQ(parameter_of(study, "b_n_first"), 4e-5);
  EXPECT_EQ(parameter_of(study, "varpi_second"), second.scales.varpi);
  EXPECT_EQ(study.setting.options, std::vector<int>{1});
  const auto curve = study.model->binding.curves.at("measured_stiffness_second");
  EXPECT_EQ(curve->at(1.0, 1.0),
            second.model->binding.curves.at("measured_stiffness")->at(1.0, 1.0));
  // Lengths of two meshes have two units.
  EXPECT_FALSE(study.scales.known());
  EXPECT_THAT(study.gear_notes, Contains(HasSubstr("[gear.second] mesh stiffness from 'k.csv'")));
  EXPECT_EQ(read_study(study.toml, "again").toml, study.toml);
}

TEST(TwoMeshes, MayBeSweptAndUncertainInUnitsOfTheDrawing) {
  const Study study = read_study(drawings() +
                                     "[[axes]]\nname = 'torque_N_m_first'\n"
                                     "values = [50, 150]\n[uncertain]\nsamples = 2\n"
                                     "mesh_damping_N_s_per_mm_second = "
                                     "{distribution = 'uniform', from = 0.4, to = 0.6}\n",
                                 "s.toml");
  ASSERT_EQ(study.axes[0].columns.size(), 1U);
  EXPECT_EQ(study.axes[0].columns[0].name, "F1_first");
  EXPECT_EQ(study.axes[0].unit, "N m");
  EXPECT_EQ(study.uncertain.parameters[0].draws.columns[0].name, "zeta_second");
  const Study given = read_study(drawings() + kOmega, "s.toml", {"gear.first.torque_N_m=50"});
  EXPECT_EQ(study.axes[0].columns[0].values.front(), parameter_of(given, "F1_first"));
  EXPECT_THAT(read_study(drawings() + kOmega, "s.toml", {"parameters.eps_second=1.4"}).notices,
              ElementsAre(HasSubstr("wins over centre_distance_mm of [gear.second]")));
}

TEST(TwoMeshes, RefuseWhatTheModelDoesNotHave) {
  const std::pair<std::string, std::string> mistakes[] = {
      {drawings("runout_um = 9\n"),
       "s.toml:52: runout_um gives runout_p_first, runout_g_first, which model 'train' does not "
       "have"},
      {drawings("tooth_entry = 'gradual'\n"),
       "tooth_entry gives engagement_first, which model 'train' does not have"},
      {drawings("", "torque_N_m = 9\n"), "torque_N_m gives F1_second, which model 'train'"},
      {drawings("", "mass = 9\n"), "unknown key 'mass' in [gear.second]"},
      {drawings("face_width_mm = 9\npitch_deviation_um = 9\nprofile_form_deviation_um = 9\n"),
       "K_v is of the drawing in whose units model 'train' is: its [model] has to say which"},
      {drawings() + "[gear.third]\n" + kFirst, "unknown key 'third' in [gear]"},
      {kModel + ("[gear]\n" + kFirst), "unknown key 'half_backlash_mm' in [gear]"},
      {kModel + std::string("[gear.first]\nmodule_mm = 4\n"),
       "[gear.first] needs 8 more keys:\n  'teeth'"}};
  for (const auto& [study, message] : mistakes) {
    EXPECT_THAT(refusal(study + kOmega), HasSubstr(message)) << study;
  }
  EXPECT_THAT(
      refusal(drawings() + kOmega, {"gear.first.transmission_error_um=[6, 2, 1]"}),
      HasSubstr("transmission_error_um gives e0_first_3 = 0.025, which model 'train' does"));
  EXPECT_THAT(refusal("[gear.first]\n" + kFirst + kOmega), HasSubstr("unknown key 'first' in"));
  std::string model = kModel;
  model.insert(model.find("[states]"), "third = \"of nothing\"\n");
  EXPECT_THAT(refusal(model + kOmega),
              AllOf(HasSubstr("the drawing 'third' gives nothing"), HasSubstr("'_third'")));
  EXPECT_THAT(refusal("[model]\nname = 'lorenz'\n[gear]\n" + kFirst),
              HasSubstr("a [gear] table belongs to model 'gear5'"));
}

// The model in the units of one of its drawings, with what K_v stands beside.
std::string in_units(const std::string& name, const std::string& unit_of_second = "N") {
  std::string text = drawings();
  const auto replace = [&](const std::string& what, const std::string& instead) {
    text.replace(text.find(what), what.size(), instead);
  };
  replace("name = \"train\"\n", "name = \"train\"\nunits = \"" + name + "\"\n");
  replace("x = {}", "x = { unit = \"b_n\" }");
  replace("F1_first = 0.1", "F1_first = { value = 0.1, role = \"load\" }");
  replace("e0_second = 0.1", "e0_second = { value = 0.1, unit = \"" + unit_of_second + "\" }");
  replace("[forcing]",
          "[signals]\nforce = { expression = \"x\", unit = \"k0 b_n\", role = "
          "\"mesh_force\" }\n[forcing]");
  return text;
}

TEST(TwoMeshes, HaveUnitsOfSiWhereTheModelSaysWhose) {
  const std::string bearings = "bearing_stiffness_N_per_mm = 1e5\nbearing_damping_N_s_per_mm = 1\n";
  const Study first = read_study("[gear]\n" + kFirst + bearings + kOmega, "first.toml");
  const Study study = read_study(in_units("first") + kOmega, "s.toml");
  EXPECT_TRUE(study.scales == first.scales);
  EXPECT_THAT(study.notices, Not(Contains(HasSubstr("units of SI"))));
  std::string without = in_units("first");
  without.erase(without.find("units = \"first\"\n"), 16);
  EXPECT_THAT(read_study(without + kOmega, "s.toml").notices,
              Contains(HasSubstr("does not say in whose units it is, so the result has no units of "
                                 "SI: units = \"first\" in its [model] would")));
  std::string alone = in_units("first");
  alone.erase(alone.find("[gear.first]"), alone.find("[gear.second]") - alone.find("[gear.first]"));
  EXPECT_THAT(read_study(alone + kOmega, "s.toml").notices,
              Contains(HasSubstr("the study has no [gear.first], so the result has no units")));
  EXPECT_THAT(refusal(in_units("third") + kOmega),
              HasSubstr("units must be the name of one of the [drawings], in quotes"));
}

// A unit of the model's drawing would turn the other one's numbers into wrong ones of SI.
TEST(TwoMeshes, KeepTheUnitsOfTheirDrawingsApart) {
  EXPECT_THAT(refusal(in_units("first", "b_n") + kOmega),
              AllOf(HasSubstr("'e0_second' is in units of the drawing 'second'"),
                    HasSubstr("unit = \"k0_second b_n_second\"")));
  EXPECT_EQ(refusal(in_units("first", "b_n_second") + kOmega), "");
  EXPECT_THAT(refusal(in_units("second") + kOmega),
              HasSubstr("'F1_first' is of the drawing 'first', and the model is in the units of "
                        "'second': the role 'load' is for a parameter of that"));
}

TEST(TwoMeshes, HaveTheDynamicFactorOfTheDrawingThatGivesTheUnits) {
  const std::string deviations =
      "face_width_mm = 20\npitch_deviation_um = 9\nprofile_form_deviation_um = 8\n";
  const auto with = [&](const std::string& drawing, std::string text) {
    return text.insert(text.find("module_mm", text.find("[gear." + drawing)), deviations);
  };
  const Study study = read_study(with("first", in_units("first")) + kOmega, "s.toml");
  const Study pair = read_study("[gear]\n" + kFirst + deviations +
                                    "bearing_stiffness_N_per_mm = 1e5\n"
                                    "bearing_damping_N_s_per_mm = 1\n" +
                                    kOmega,
                                "pair.toml");
  ASSERT_TRUE(study.dynamic_factor && pair.dynamic_factor);
  // Where there are several forces, none has the one factor that K_v stands beside.
  std::string two = in_units("first");
  two.insert(two.find("force = {"), "other = { expression = \"2*x\", role = \"mesh_force\" }\n");
  EXPECT_THAT(refusal(with("first", two) + kOmega), HasSubstr("one signal of the role"));
  EXPECT_EQ(dynamic_factor(*study.dynamic_factor, 50.0, 0.7),
            dynamic_factor(*pair.dynamic_factor, 50.0, 0.7));
  EXPECT_THAT(refusal(with("second", in_units("first")) + kOmega),
              HasSubstr("K_v is of the drawing in whose units model 'train' is: [gear.first]"));
  std::string plain = with("first", in_units("first"));
  plain.replace(plain.find(", role = \"load\""), 15, "");
  EXPECT_THAT(refusal(plain + kOmega),
              HasSubstr("needs a parameter of the role \"load\" whose name "
                        "ends in _first"));
}

// A train in text. stiffness: of both meshes; lines: in both drawings.
Study train_of(const std::string& model, double stiffness, double omega, const std::string& lines) {
  const std::string both = fmt::format(
      "module_mm = 3\nhalf_backlash_mm = 0.05\nmesh_stiffness_N_per_m = {}\n"
      "mesh_damping_ratio = 0.05\ntransmission_error_um = 4\n{}",
      stiffness, lines);
  return read_study(
      fmt::format(
          "[model]\nname = '{}'\n[parameters]\nomega = {}\n[[axes]]\nname = 'q'\nvalues = [0.35]\n"
          "[gear.first]\nteeth = [20, 30]\ninertia_kg_mm2 = [350, 900]\n"
          "torque_N_m = 40\n{}[gear.second]\nteeth = [30, 36]\n"
          "inertia_kg_mm2 = [900, 2000]\n{}",
          model, omega, both, both),
      "train.toml");
}

// Velocities are in b_n varpi, and varpi goes with the root of the stiffness.
std::vector<double> in_stiffer_units(const Study& study, std::vector<double> states,
                                     double stiffer) {
  for (std::size_t i = 0; i < states.size(); ++i) {
    const char kind = study.model->states[i].name.front();
    if (kind == 'v' || kind == 'w') states[i] /= std::sqrt(stiffer);
  }
  return states;
}

// With a factor the units stay, and the motion is that of teeth so much stiffer.
TEST(TwoMeshes, AStiffnessFactorIsADrawingOfSuchAStiffness) {
  constexpr double kFactor = 0.7, kStiffness = 2.2e8, kOmegaOfFactor = 0.6;
  for (const char* name : {"idler", "two_stages"}) {
    const Study factor =
        train_of(name, kStiffness, kOmegaOfFactor, fmt::format("stiffness_factor = {}\n", kFactor));
    const Study drawing =
        train_of(name, kFactor * kStiffness, kOmegaOfFactor / std::sqrt(kFactor), "");
    const Model& model = *factor.model;
    std::vector<double> x = model.equilibrium(factor.setting);
    EXPECT_THAT(
        drawing.model->equilibrium(drawing.setting),
        ::testing::Pointwise(::testing::DoubleNear(1e-9), in_stiffer_units(factor, x, kFactor)))
        << name;
    for (std::size_t i = 0; i < x.size(); ++i) {
      const bool is_twist = model.states[i].name == "u" || model.states[i].name == "w";
      if (!is_twist) x[i] += 0.1 + 0.05 * static_cast<double>(i);  // the shaft is rigid
    }
    const std::vector<double> other = in_stiffer_units(factor, x, kFactor);
    const auto rates = [](const Study& study, const std::vector<double>& states) {
      std::vector<double> row(study.model->phase_coefs.size()), out(states.size());
      study.model->phase_coefs_at(study.setting, 0.013, 0.013, row.data());
      study.model->prepare(study.setting)->rhs(row.data(), states.data(), out.data());
      return out;
    };
    std::vector<double> expected = in_stiffer_units(factor, rates(factor, x), kFactor);
    for (double& rate : expected) rate /= std::sqrt(kFactor);  // time, too
    EXPECT_THAT(rates(drawing, other), ::testing::Pointwise(::testing::DoubleNear(1e-9), expected))
        << name;
  }
}

}  // namespace
}  // namespace gearsweep::testing
