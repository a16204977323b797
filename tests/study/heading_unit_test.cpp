// Units in the headings of measured files: the same curve in each of them is the same study.
#include "study/detail/heading_unit.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "study/refusal.hpp"
#include "study/study.hpp"
#include "support/folder.hpp"

namespace gearsweep::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

// What [gear] needs besides a stiffness and an error.
const char* const kRest =
    "[[axes]]\nname = 'omega'\nvalues = [0.5, 0.7]\n[gear]\nteeth = [20, 30]\nmodule_mm = 3\n"
    "inertia_kg_mm2 = 2230\nmass_kg = 1\n"
    "bearing_stiffness_N_per_mm = 3e5\nbearing_damping_N_s_per_mm = 1.4\n"
    "mesh_damping_N_s_per_mm = 0.7\nhalf_backlash_mm = 0.05\ntorque_N_m = 61\n"
    "contact_ratio = 1.3\n";

struct MeasuredFile {
  std::string key, besides;
  std::string unit;                // as a file without a heading has it
  std::vector<std::string> lines;  // but for the values
};

const std::vector<MeasuredFile>& measured_files() {
  const std::string stiffness = "mesh_stiffness_N_per_m = 2e8\n",
                    error = "transmission_error_um = 1\n";
  const std::vector<std::string> turn = {"0, ", "2, ", "4, "}, path = {"0, ", "0.5, ", "1, "};
  static const std::vector<MeasuredFile> kFiles = {
      {"stiffness_file", error, "N/m", turn},
      {"transmission_error_file", stiffness, "um", turn},
      {"profile_deviation_file", stiffness + error, "um", path},
      {"pinion_pitch_error_file", stiffness + error, "um", std::vector<std::string>(20)},
      {"gear_pitch_error_file", stiffness + error, "um", std::vector<std::string>(30)}};
  return kFiles;
}

std::string text_of(const MeasuredFile& file, const std::string& heading, double scale) {
  std::string text = heading;
  double value = 3.0;
  for (const std::string& line : file.lines) {
    text += fmt::format("{}{}\n", line, value * scale);
    value = value == 3.0 ? 5.0 : 2.0;
  }
  return text;
}

std::string study_with(const MeasuredFile& file) {
  return kRest + file.besides + file.key + " = 'f.csv'\n";
}

Study study_beside(const Folder& folder, const MeasuredFile& file, const std::string& heading,
                   double scale) {
  folder.write("f.csv", text_of(file, heading, scale));
  return read_study(study_with(file), (folder / "s.toml").string());
}

// As the first words of the file.
std::string heading_of(const MeasuredFile& file, const std::string& unit) {
  const bool has_place = !file.lines.front().empty();
  const bool is_path = file.key == "profile_deviation_file";
  return fmt::format("{}{}\n", has_place ? is_path ? "share, " : "phase, " : "", unit);
}

TEST(HeadingUnit, OfOneCurveGiveOneStudy) {
  const Folder folder;
  for (const MeasuredFile& file : measured_files()) {
    const bool is_stiffness = file.unit == "N/m";
    const double base = is_stiffness ? 1e6 : 1.0;
    const std::string plain = study_beside(folder, file, "", base).toml;
    for (const ValueUnit& unit :
         is_stiffness ? std::span<const ValueUnit>(kStiffnessUnits) : kLengthUnits) {
      for (const char* form : {"{}", "value ({})", "[{}]"}) {
        const std::string words = fmt::format(fmt::runtime(form), unit.name);
        const std::string given =
            study_beside(folder, file, heading_of(file, words), base / unit.scale).toml;
        EXPECT_EQ(given, plain) << file.key << " " << words;
      }
    }
    // The micro sign, and a name that is no unit.
    const std::string micro = is_stiffness ? "N/\xC2\xB5m" : "\xCE\xBCm";
    EXPECT_EQ(study_beside(folder, file, heading_of(file, micro), 1.0).toml, plain);
    EXPECT_EQ(study_beside(folder, file, heading_of(file, "measured"), base).toml, plain);
  }
}

// The text of a study may hold the file as it is.
TEST(HeadingUnit, HoldInsideOfAStudy) {
  const MeasuredFile& file = measured_files().front();
  const auto held = [&](const std::string& unit, double scale) {
    return read_study(study_with(file) + "[gear.tables]\n'f.csv' = '''\n" +
                          text_of(file, heading_of(file, unit), scale) + "'''\n",
                      "s.toml")
        .scales.k0;
  };
  EXPECT_EQ(held("N/mm", 1e3), held("N/m", 1e6));
  EXPECT_NEAR(held("N/m", 1e6), 3.3e6, 1e6);
}

TEST(HeadingUnit, OthersAreRefusedWithTheOnesThereAre) {
  const Folder folder;
  for (const MeasuredFile& file : measured_files()) {
    const bool is_stiffness = file.unit == "N/m";
    for (const std::string unit : {"nm", "inch", "(furlong)", "lbf/in", "error_N/mm",
                                   is_stiffness ? "mm" : "N/mm", is_stiffness ? "k_mm" : "e_mm"}) {
      folder.write("f.csv", text_of(file, heading_of(file, unit), 1.0));
      std::string message;
      try {
        read_study(study_with(file), (folder / "s.toml").string());
      } catch (const InputError& error) {
        message = error.what();
      }
      EXPECT_THAT(message, AllOf(HasSubstr("s.toml:"), HasSubstr("f.csv:1: '" + unit + "' is no"),
                                 HasSubstr(is_stiffness ? "N/m, N/mm, N/um" : "um, mm, m")))
          << file.key;
    }
  }
}

// A torque's unit may be of two words. Its curve is that of the force on the base circle.
TEST(HeadingUnit, OfATorqueHasItsBlankOrNone) {
  std::string rest = kRest;
  const std::string torque = "torque_N_m = 61\n";
  rest.erase(rest.find(torque), torque.size());
  const auto load_of = [&](const std::string& heading, double scale) {
    const Study study = read_study(
        rest + "mesh_stiffness_N_per_m = 2e8\ntransmission_error_um = 1\ntorque_file = 't.csv'\n" +
            fmt::format("[gear.tables]\n't.csv' = '''\n{}0, {}\n120, {}\n240, {}\n'''\n", heading,
                        50.0 * scale, 70.0 * scale, 60.0 * scale),
        "s.toml");
    return study.setting.parameters[static_cast<std::size_t>(study.model->find_parameter("F1"))];
  };
  const double load = load_of("degree\n", 1.0);
  EXPECT_GT(load, 0.0);
  for (const char* heading : {"degree, N m\n", "degree; torque (N m)\n", "degree, Nm\n",
                              "degree, torque [Nm]\n", "degree torque_Nm\n"}) {
    EXPECT_EQ(load_of(heading, 1.0), load) << heading;
  }
  EXPECT_NEAR(load_of("degree, kN m\n", 1e-3), load, 1e-12);
  EXPECT_NEAR(load_of("degree, (N mm)\n", 1e3), load, 1e-12);
  EXPECT_THROW(load_of("degree, ft lb\n", 1.0), InputError);
  EXPECT_THROW(load_of("time, N m\n", 1.0), InputError);
}

}  // namespace
}  // namespace gearsweep::testing
