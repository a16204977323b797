// The study of a new gear pair runs, and says what is guessed.
#include "study/new_gear.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "gear/drawing_keys.hpp"
#include "model/error.hpp"
#include "study/study.hpp"

namespace gearsweep::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(NewGear, IsAStudyWithEveryKey) {
  const std::string text = new_gear_study({{19, 61}, 2.5, {}, {}, {}});
  const Study study = read_study(text, "new.toml");
  EXPECT_TRUE(study.scales.known());
  EXPECT_EQ(study.axes[0].name, "pinion_speed_rpm");
  EXPECT_TRUE(study.notices.empty()) << ::testing::PrintToString(study.notices);
  for (const GearKey& key : kGearKeys) {
    EXPECT_TRUE(text.find("\n" + std::string(key.name) + " = ") != std::string::npos ||
                text.find("\n# " + std::string(key.name) + " = ") != std::string::npos)
        << key.name;
  }
  EXPECT_THAT(text, HasSubstr("ESTIMATE: 100 N for each mm"));
}

TEST(NewGear, MarksOnlyWhatNobodyGave) {
  const std::string text = new_gear_study({{23, 47}, 3.0, 30.0, 80.0, 12.0});
  EXPECT_THAT(text, AllOf(HasSubstr("\nface_width_mm = 30\n"), HasSubstr("\ntorque_N_m = 80\n"),
                          HasSubstr("\nhelix_angle_deg = 12\n"), Not(HasSubstr("100 N for each"))));
  EXPECT_GT(read_study(text, "new.toml").scales.varpi, 0.0);
}

// What is marked in words is marked for reports, too.
TEST(NewGear, SaysToReportsWhatIsGuessed) {
  const Study study = read_study(new_gear_study({{19, 61}, 2.5, {}, 80.0, {}}), "new.toml");
  const auto origin = [&](const GearKey& key) {
    return std::ranges::find(study.gear_data, key.name, &GearDatum::key)->origin;
  };
  EXPECT_EQ(origin(kFaceWidth), DatumOrigin::estimated);
  EXPECT_EQ(origin(kHalfBacklash), DatumOrigin::estimated);
  EXPECT_EQ(origin(kMass), DatumOrigin::estimated);
  EXPECT_EQ(origin(kTorque), DatumOrigin::given);
  EXPECT_EQ(origin(kModule), DatumOrigin::given);
}

TEST(NewGear, ListsOnlyKeysAsGuesses) {
  const std::string text = new_gear_study({{19, 61}, 2.5, {}, {}, {}});
  for (const char* wrong : {"'torque'", "3"}) {
    EXPECT_THAT([&] { read_study(text, "s", {fmt::format("gear.estimated=[{}]", wrong)}); },
                ::testing::ThrowsMessage<InputError>(HasSubstr("a list of keys of the table")))
        << wrong;
  }
  // The name of a guess that a measured one replaces may stay.
  EXPECT_NO_THROW(read_study(text, "s", {"gear.estimated=['mass_kg']"}));
}

// Pairs of all sizes, from watches to mills, are without doubts.
TEST(NewGear, IsOfAnySize) {
  for (const double module : {0.1, 1.0, 8.0, 40.0}) {
    for (const auto& [pinion, gear] : {std::pair{17, 18}, {20, 20}, {19, 61}, {30, 200}}) {
      const Study study =
          read_study(new_gear_study({{pinion, gear}, module, {}, {}, {}}), "new.toml");
      EXPECT_TRUE(study.notices.empty())
          << module << " " << pinion << " " << ::testing::PrintToString(study.notices);
      EXPECT_LT(study.axes[0].values.front(), study.axes[0].values.back());
    }
  }
}

TEST(NewGear, RefusesGearsThatThereCannotBe) {
  EXPECT_THROW(new_gear_study({{1, 61}, 2.5, {}, {}, {}}), InputError);
  EXPECT_THROW(new_gear_study({{19, 61}, 1e9, {}, {}, {}}), InputError);
}

}  // namespace
}  // namespace gearsweep::testing
