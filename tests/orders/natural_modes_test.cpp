// Natural frequencies against closed forms.
#include "orders/natural_modes.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>

#include "study/study.hpp"
#include "support/settings.hpp"

namespace gearsweep {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;

constexpr const char* kAxis = "[[axes]]\nname = 'omega'\nvalues = [0.7]\n";

std::vector<double> frequencies_of(const std::string& study_text) {
  const Study study = read_study(study_text + kAxis, "test");
  std::vector<double> frequencies;
  for (const NaturalMode& mode : natural_modes(*study.model, study.setting)) {
    frequencies.push_back(mode.frequency);
  }
  return frequencies;
}

std::string gear(const std::string& more) {
  return "[model]\nname = 'gear5'\n[parameters]\nmu = 0.0\n" + more;
}

// Equal gears with K = m k and L = w^2: sqrt(K) three times, and the roots of
// L^2 - (1 + K + 2 m) L + K = 0.
TEST(NaturalModes, OfEqualGearsAreThoseOfTheClosedForm) {
  for (const auto& [m, k] : {std::pair{0.3507525, 1.38}, std::pair{0.2, 2.5}}) {
    const double squared = m * k;
    const double half = 0.5 * (1.0 + squared + 2.0 * m);
    const double root = std::sqrt(half * half - squared);
    const double bearing = std::sqrt(squared);
    const auto near = [](double value) { return DoubleNear(value, 1e-9); };
    std::string more = "zeta = 0.0\n";
    for (const char* name : {"m1", "m2"}) more += fmt::format("{} = {}\n", name, m);
    for (const char* name : {"k1", "k2", "k3", "k4"}) more += fmt::format("{} = {}\n", name, k);
    EXPECT_THAT(frequencies_of(gear(more)),
                ElementsAre(near(std::sqrt(half - root)), near(bearing), near(bearing),
                            near(bearing), near(std::sqrt(half + root))));
  }
}

TEST(NaturalModes, OfThePresetAreKnownToThreeDigits) {
  const auto near = [](double value) { return DoubleNear(value, 5e-4); };
  EXPECT_THAT(frequencies_of("[model]\nname = 'gear5'\npreset = 'consistent'\n"),
              ElementsAre(near(0.5), near(0.696), near(0.696), near(0.696), near(1.391)));
}

// x'' + 2 z w x' + w^2 x = F: the stiffness that varies with the phase counts by its mean.
TEST(NaturalModes, TellTheDampingRatioAndTakeTheMeanStiffness) {
  const Study study = read_study(
      "[model]\ntext = '''\n[model]\nname = \"one\"\n[states]\nx = {}\nv = {}\n"
      "[parameters]\nomega = { value = 1.0, min = 0.1, max = 9 }\n"
      "[equations]\nx = \"v\"\n"
      "v = \"1 - 2*0.1*3*v - 9*(1 + 0.3*cos(phase) + 0.2*sin(4*phase))*x\"\n"
      "[forcing]\nperiod = \"2*pi/omega\"\n'''\n" +
          std::string(kAxis),
      "test");
  const std::vector<NaturalMode> modes = natural_modes(*study.model, study.setting);
  ASSERT_EQ(modes.size(), 1U);
  EXPECT_NEAR(modes[0].frequency, 3.0, 1e-9);
  EXPECT_NEAR(modes[0].damping, 0.1, 1e-9);
}

TEST(NaturalModes, AreNoneWhereNothingOscillates) {
  EXPECT_THAT(frequencies_of("[model]\ntext = '''\n[model]\nname = \"slow\"\n[states]\nx = {}\n"
                             "[parameters]\nomega = { value = 1.0, min = 0.1, max = 9 }\n"
                             "[equations]\nx = \"cos(phase) - x\"\n"
                             "[forcing]\nperiod = \"2*pi/omega\"\n'''\n"),
              ElementsAre());
}

}  // namespace
}  // namespace gearsweep
