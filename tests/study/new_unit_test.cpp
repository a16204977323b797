// Studies of three gears in a row, of two stages and of planetary sets, begun with numbers of
// teeth, have the numbers of the same gears drawn by hand.
#include "study/new_unit.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "model/error.hpp"
#include "study/draft.hpp"
#include "study/study.hpp"

namespace gearsweep::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr double kSteelDensity = 7.85e-6;  // kg/mm^3
constexpr double kDegree = std::numbers::pi / 180.0;

NewUnit idler() {
  return {GearArrangement::idler, {19, 33, 61}, {2.5, 2.5}, {25.0, 25.0}, {}, 60.0};
}

NewUnit stages() {
  return {GearArrangement::two_stages, {20, 41, 18, 45}, {2.5, 4.0}, {25.0, 40.0}, {}, 60.0};
}

NewUnit planets() {
  return {GearArrangement::planetary, {28, 35, 98}, {2.0, 2.0}, {30.0, 30.0}, {}, 240.0};
}

double disc_mass(double teeth, double module, double width) {
  const double radius = 0.5 * module * teeth;
  return kSteelDensity * std::numbers::pi * radius * radius * width;
}

double disc_inertia(double teeth, double module, double width) {
  return 0.5 * disc_mass(teeth, module, width) * std::pow(0.5 * module * teeth, 2);
}

// What a drawing without estimates has of two gears. more: its other keys.
std::string drawn(const std::string& name, int pinion, int gear, double module, double width,
                  const std::string& more) {
  return fmt::format(
      "[gear.{}]\nteeth = [{}, {}]\nmodule_mm = {}\nface_width_mm = {}\ninertia_kg_mm2 = [{:.17g}, "
      "{:.17g}]\nmesh_damping_ratio = 0.07\nhalf_backlash_mm = {}\ntransmission_error_um = 5\n{}",
      name, pinion, gear, module, width, disc_inertia(pinion, module, width),
      disc_inertia(gear, module, width), 0.025 * module, more);
}

// Rounding of inertias in other orders, and of the six digits that estimates have. The speed is
// that of the axis.
void expect_the_same(const Study& written, const Study& by_hand) {
  ASSERT_EQ(written.model->name, by_hand.model->name);
  for (std::size_t i = 0; i < by_hand.model->parameters.size(); ++i) {
    if (by_hand.model->parameters[i].name == "omega") continue;
    const double value = by_hand.setting.parameters[i];
    EXPECT_NEAR(written.setting.parameters[i], value, 3e-6 * std::abs(value) + 1e-300)
        << by_hand.model->parameters[i].name;
  }
  EXPECT_EQ(written.setting.options, by_hand.setting.options);
}

TEST(NewUnit, OfThreeGearsInARowIsThatDrawnByHand) {
  const std::string text = new_unit_study(idler());
  const Study study = read_study(text, "new.toml");
  EXPECT_TRUE(study.notices.empty()) << ::testing::PrintToString(study.notices);
  EXPECT_EQ(study.axes[0].name, "pinion_speed_rpm_first");
  EXPECT_THAT(text, AllOf(HasSubstr("\ntorque_N_m = 60\n"), HasSubstr("\n[gear.second]\n"),
                          HasSubstr("ESTIMATE: the three axes lie in a line")));
  const std::string hand = "[model]\nname = 'idler'\n" +
                           drawn("first", 19, 33, 2.5, 25.0, "torque_N_m = 60\n") +
                           drawn("second", 33, 61, 2.5, 25.0, "") + "[parameters]\nangle = 180\n";
  expect_the_same(read_draft(text, "new.toml"), read_draft(hand, "hand.toml"));
}

TEST(NewUnit, OfTwoStagesIsThatDrawnByHand) {
  const std::string text = new_unit_study(stages());
  const Study study = read_study(text, "new.toml");
  EXPECT_EQ(study.axes[0].name, "pinion_speed_rpm_first");
  const std::string hand = "[model]\nname = 'two_stages'\n" +
                           drawn("first", 20, 41, 2.5, 25.0, "torque_N_m = 60\n") +
                           drawn("second", 18, 45, 4.0, 40.0, "");
  expect_the_same(read_draft(text, "new.toml"), read_draft(hand, "hand.toml"));
}

// The contact ratio of planet and ring by the formula of text books.
TEST(NewUnit, OfAPlanetarySetIsThatDrawnByHand) {
  const std::string text = new_unit_study(planets());
  const Study study = read_study(text, "new.toml");
  EXPECT_TRUE(study.notices.empty()) << ::testing::PrintToString(study.notices);
  EXPECT_EQ(study.axes[0].name, "pinion_speed_rpm_sun");
  const double apart = 28.0 + 35.0, cosine = std::cos(20.0 * kDegree),
               sine = std::sin(20.0 * kDegree);
  const double planet = std::sqrt(37.0 * 37.0 - std::pow(35.0 * cosine, 2));
  const double ring = std::sqrt(96.0 * 96.0 - std::pow(98.0 * cosine, 2));
  const double eps = (planet - ring + apart * sine) / (2.0 * std::numbers::pi * cosine);
  const double mass = 3.0 * disc_mass(35, 2.0, 30.0);
  const std::string hand =
      "[model]\nname = 'planetary'\n" +
      drawn("sun", 28, 35, 2.0, 30.0,
            fmt::format("torque_N_m = 240\nmass_kg = [{:.17g}, {:.17g}]\n",
                        disc_mass(28, 2.0, 30.0), disc_mass(35, 2.0, 30.0))) +
      fmt::format(
          "[parameters]\nz_ring = 98\neps_ring = {:.17g}\napproach_ring = {:.17g}\n"
          "e0_ring = {:.17g}\nmass_carrier = {:.4g}\ninertia_carrier = {:.4g}\nk_sun = 2e8\nk_pin "
          "= 2e8\nk_carrier = 2e8\nturn_carrier = 24000\n",
          eps, (98.0 * sine - ring) / (2.0 * std::numbers::pi * cosine) / eps, 5e-3 / 0.05, mass,
          1e-6 * mass * apart * apart);
  expect_the_same(read_draft(text, "new.toml"), read_draft(hand, "hand.toml"));
}

TEST(NewUnit, MarksOnlyWhatNobodyGave) {
  NewUnit unit = planets();
  EXPECT_THAT(new_unit_study(unit), Not(HasSubstr("at each of three planets")));
  unit.torque_N_m = std::nullopt;
  // 100 N at each mm of 30, three times, on a radius of 28 mm.
  EXPECT_THAT(new_unit_study(unit),
              AllOf(HasSubstr("\ntorque_N_m = 250\n"), HasSubstr("at each of three planets")));
}

TEST(NewUnit, SaysToReportsWhatIsGuessed) {
  const std::string text = new_unit_study(planets());
  const Study study = read_study(text, "new.toml");
  const auto origin = [&](const char* name) {
    return study.parameter_origins[static_cast<std::size_t>(study.model->find_parameter(name))];
  };
  EXPECT_THAT(origin("mass_carrier"), HasSubstr("estimated, new.toml:"));
  EXPECT_THAT(origin("z_ring"), Not(HasSubstr("estimated")));
  EXPECT_THAT([&] { read_study(text, "s", {"parameters.estimated=['torque']"}); },
              ::testing::ThrowsMessage<InputError>(HasSubstr("'torque' is none")));
  EXPECT_THAT([&] { read_study(text, "s", {"parameters.estimated=3"}); },
              ::testing::ThrowsMessage<InputError>(HasSubstr("is a list of parameters")));
  // One that is not given any more may stay in the list.
  EXPECT_NO_THROW(read_study(text, "s", {"parameters.estimated=['k_ring']"}));
}

// Of watches and mills, with few teeth and with many.
TEST(NewUnit, IsOfAnySize) {
  for (const double module : {0.2, 2.0, 20.0}) {
    for (NewUnit unit : {idler(), stages(), planets()}) {
      unit.module_mm = {module, 1.5 * module};
      if (unit.arrangement != GearArrangement::two_stages) unit.module_mm[1] = module;
      unit.face_width_mm = {};
      unit.torque_N_m = std::nullopt;
      const Study study = read_study(new_unit_study(unit), "new.toml");
      EXPECT_LT(study.axes[0].values.front(), study.axes[0].values.back());
    }
  }
  for (const std::vector<int>& teeth : {std::vector{18, 18, 54}, {30, 18, 66}, {24, 60, 144}}) {
    const NewUnit unit = {GearArrangement::planetary, teeth, {1.0, 1.0}, {}, {12.0, 12.0}, {}};
    EXPECT_NO_THROW(read_study(new_unit_study(unit), "new.toml")) << teeth[0];
  }
}

// The ring of 54 has tips of radius 26 modules: its path would begin 3.54 modules before the pitch
// point, and the involutes of a planet of 15 teeth reach 7.5 sin(20 degrees) = 2.57.
TEST(NewUnit, CutsTheTipsOfARingThatWouldInterfere) {
  NewUnit unit = planets();
  unit.teeth = {24, 15, 54};
  const std::string text = new_unit_study(unit);
  EXPECT_THAT(text, HasSubstr("cut back to where the involutes"));
  const Study study = read_draft(text, "new.toml");
  const double pitch = std::numbers::pi * std::cos(20.0 * kDegree);
  const auto parameter = [&](const char* name) {
    return study.setting.parameters[static_cast<std::size_t>(study.model->find_parameter(name))];
  };
  EXPECT_NEAR(parameter("eps_ring") * parameter("approach_ring"),
              7.5 * std::sin(20.0 * kDegree) / pitch, 1e-5);
  EXPECT_THAT(new_unit_study(planets()), Not(HasSubstr("cut back")));
}

TEST(NewUnit, RefusesGearsThatCannotBeAssembled) {
  NewUnit unit = planets();
  unit.teeth[2] = 97;
  EXPECT_THAT([&] { new_unit_study(unit); },
              ::testing::ThrowsMessage<InputError>(
                  HasSubstr("three planets cannot be put in at equal angles")));
  unit.teeth[2] = 128;
  EXPECT_THAT([&] { new_unit_study(unit); },
              ::testing::ThrowsMessage<InputError>(HasSubstr("is too large for this sun")));
}

}  // namespace
}  // namespace gearsweep::testing
