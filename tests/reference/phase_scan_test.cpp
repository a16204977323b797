// The reference engine's look at the phases of jumps, where the model does not say them.
#include "reference/detail/phase_scan.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "study/study.hpp"

namespace gearsweep::testing {
namespace {

Study study_with(const std::string& wave) {
  return read_study(
      "[model]\ntext = '''\n[model]\nname = 'wave'\n[states]\nx = { unit = '1' }\n"
      "[parameters]\nc = 0.5\n[equations]\nx = \"" +
          wave +
          " - c*x\"\n[forcing]\nperiod = '2*pi'\n'''\n[[axes]]\nname = 'x'\n"
          "values = [0.0]\n",
      "test.toml");
}

// The ends of the grid's segments.
std::vector<double> ends_of(const PhaseGrid& grid) {
  std::vector<double> ends;
  double phase = 0.0;
  for (std::size_t i = 0; i < grid.segment_steps.size(); ++i) {
    phase += grid.segment_steps[i] * grid.segment_fractions[i];
    ends.push_back(phase);
  }
  return ends;
}

TEST(PhaseScan, SeesJumpsThatTheModelDoesNotSay) {
  const Study study = study_with("if(phase < 1, 0.3, 0.9) + if(sin(phase) < 0, sin(phase), 0)");
  Model model = *study.model;
  const auto near = [](double phase) { return ::testing::DoubleNear(phase, 1e-9); };
  const double one = 0.15915494309189535;
  EXPECT_THAT(ends_of(make_phase_grid(model, study.setting, 100)),
              ::testing::ElementsAre(near(one), near(0.5), near(1.0)));
  model.break_phases = [](const ModelSetting&) { return std::vector<double>{0.0}; };
  EXPECT_THAT(ends_of(make_phase_grid(model, study.setting, 100)),
              ::testing::ElementsAre(near(1.0)));
  EXPECT_THAT(ends_of(scanned_phase_grid(model, study.setting, 100)),
              ::testing::ElementsAre(near(one), near(0.5), near(1.0)));
}

TEST(PhaseScan, ChangesNoGridOfAModelThatSaysAll) {
  for (const char* wave : {"abs(sin(2*phase))", "floor(3*phase/(2*pi) + c)", "cos(phase)",
                           "sqrt(max(sin(phase), 0))", "atan(tan(phase))"}) {
    const Study study = study_with(wave);
    const PhaseGrid own = scanned_phase_grid(*study.model, study.setting, 100);
    const PhaseGrid given = make_phase_grid(*study.model, study.setting, 100);
    EXPECT_EQ(own.segment_fractions, given.segment_fractions) << wave;
    EXPECT_EQ(own.coefs, given.coefs) << wave;
  }
}

}  // namespace
}  // namespace gearsweep::testing
