// Load spectra: lists of points in the units of a drawing, with the share of time of each.
#include "study/load_spectrum.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "study/refusal.hpp"
#include "study/study.hpp"

namespace gearsweep::testing {
namespace {

using ::testing::Contains;
using ::testing::DoubleEq;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

// Its engagement follows from the torque.
const std::string kLoadedDrawing =
    "[gear]\nteeth = [20, 40]\nmodule_mm = 4.0\ninertia_kg_mm2 = [600, 9000]\n"
    "mass_kg = [0.9, 3.2]\nbearing_stiffness_N_per_mm = 2e5\nbearing_damping_N_s_per_mm = 2\n"
    "mesh_damping_ratio = 0.06\nhalf_backlash_mm = 0.04\nface_width_mm = 30\n"
    "transmission_error_um = 6\ntooth_entry = 'gradual'\n";

std::string list_of(const std::string& names, const std::string& lines) {
  return "[points]\nnames = [" + names + "]\nnumbers = '''\n" + lines + "'''\n";
}

const std::string kLoads =
    list_of("'torque_N_m', 'pinion_speed_rpm', 'time_share'", "50,800,0.2\n150,3000,0.8\n");

// As one study for each point says.
TEST(LoadSpectrum, PointsHaveWhatTheDrawingGivesForAllTheirKeys) {
  const Study spectrum = read_study(kLoadedDrawing + kLoads, "s.toml");
  ASSERT_EQ(spectrum.points(), 2U);
  const std::pair<double, double> loads[] = {{50.0, 800.0}, {150.0, 3000.0}};
  for (std::size_t point = 0; point < 2; ++point) {
    const auto [torque, speed] = loads[point];
    const Study one = read_study(
        kLoadedDrawing + fmt::format("torque_N_m = {}\npinion_speed_rpm = {}\n", torque, speed) +
            "[[axes]]\nname = 'mu'\nvalues = [0.05]\n",
        "one.toml");
    std::vector<double> parameters = spectrum.setting.parameters;
    for (const Swept* swept : spectrum.swept()) {
      parameters[swept->index] = swept->values[point];
    }
    EXPECT_EQ(parameters, one.setting.parameters) << point;
  }
  const auto engagement = static_cast<std::size_t>(spectrum.model->find_parameter("engagement"));
  EXPECT_NE(spectrum.find_on_axes(engagement), nullptr) << "it follows from the torque";
}

TEST(LoadSpectrum, HasSharesThatAddUpToOne) {
  const Study whole = read_study(kLoadedDrawing + kLoads, "s.toml");
  ASSERT_TRUE(whole.spectrum);
  EXPECT_THAT(whole.spectrum->shares, ElementsAre(DoubleEq(0.2), DoubleEq(0.8)));
  EXPECT_EQ(whole.spectrum->slope, 6.61);
  EXPECT_THAT(whole.notices, Not(Contains(HasSubstr("shares of time"))));
  // Hours.
  const Study hours =
      read_study(kLoadedDrawing + list_of("'torque_N_m', 'time_share'", "50,3000\n150,1000\n") +
                     "slope = 8.738\n",
                 "s.toml");
  EXPECT_THAT(hours.spectrum->shares, ElementsAre(0.75, 0.25));
  EXPECT_THAT(hours.notices, Contains(HasSubstr("the shares of time add up to 4000, not to 1")));
  EXPECT_EQ(hours.spectrum->slope, 8.738);
}

TEST(LoadSpectrum, LooksAtForcesFactorsAndContactByItself) {
  const Study study = read_study(kLoadedDrawing + kLoads, "s.toml");
  std::vector<std::string> names;
  for (const Quantity& quantity : study.selection.quantities) names.push_back(quantity.name);
  EXPECT_THAT(names, ElementsAre("dmf_max", "dynamic_load_factor", "contact_class"));
}

TEST(LoadSpectrum, IsReadAgainFromWhatItSays) {
  const Study study = read_study(kLoadedDrawing + kLoads, "s.toml");
  EXPECT_EQ(read_study(study.toml, "again").toml, study.toml);
  const PointTable points{{"torque_N_m", "pinion_speed_rpm", "time_share"},
                          {{50.0, 150.0}, {800.0, 3000.0}, {0.2, 0.8}}};
  EXPECT_EQ(read_study(study.brief_toml(), "r.nc", {}, {}, points).toml, study.toml);
}

TEST(LoadSpectrum, IsRefusedWhereItSaysNothing) {
  EXPECT_THAT(refusal(kLoadedDrawing + list_of("'torque_N_m', 'time_share'", "50,-1\n")),
              HasSubstr("point 1: time_share = -1 is out of range"));
  EXPECT_THAT(refusal(kLoadedDrawing + list_of("'torque_N_m', 'time_share'", "50,0\n")),
              HasSubstr("no point has a time_share above 0"));
  EXPECT_THAT(refusal(kLoadedDrawing + list_of("'torque_N_m'", "50\n") + "slope = 3\n"),
              HasSubstr("slope is of a load spectrum, which has a column time_share"));
  EXPECT_THAT(refusal(kLoadedDrawing + kLoads + "[[axes]]\nname = 'mu'\nvalues = [0.1]\n"),
              HasSubstr("no axis can stand beside it"));
  EXPECT_THAT(refusal(kLoadedDrawing + list_of("'torque_N_m', 'share'", "50,1\n")),
              HasSubstr("did you mean 'time_share'?"));
  EXPECT_THAT(refusal(kLoadedDrawing + list_of("'torque_N_m', 'speed_rpm'", "50,1000\n")),
              HasSubstr("did you mean 'pinion_speed_rpm'?"));
  EXPECT_THAT(
      refusal(kLoadedDrawing + list_of("'torque_N_m', 'omega', 'pinion_speed_rpm'", "50,1,9\n")),
      HasSubstr("two columns give omega"));
  EXPECT_THAT(refusal(kLoadedDrawing + list_of("'torque_N_m', 'module_mm'", "50,4\n60,4.1\n")),
              HasSubstr("point 2: what the result is measured in would change"));
}

}  // namespace
}  // namespace gearsweep::testing
