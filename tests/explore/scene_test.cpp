// What a page shows: a world around the first view, cells that are the same at every depth.
#include "explore/scene.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "explore/explored.hpp"
#include "explore/view_study.hpp"
#include "model/error.hpp"
#include "study/draft.hpp"

namespace gearsweep::testing {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

TEST(Scene, ReachesBeyondTheFirstViewAndNeverToAnotherSign) {
  const Scene scene(explored(), {});
  EXPECT_THAT(scene.first_view()[0], ElementsAre(0.8, 1.6));
  EXPECT_DOUBLE_EQ(scene.value_at(0, 0.0), 0.25 * 0.8);
  EXPECT_DOUBLE_EQ(scene.value_at(0, 1.0), 1.6 + 1.5 * 0.8);
  EXPECT_DOUBLE_EQ(scene.value_at(1, 0.0), 0.1 / 8.0);
  EXPECT_DOUBLE_EQ(scene.value_at(1, 1.0), 0.4 * 8.0);
}

TEST(Scene, AFinerCellHasTheBitsOfTheCoarserOneAtItsPlace) {
  const Scene scene(explored(), {});
  for (const std::size_t depth : {5U, 20U, 50U}) {
    const std::uint64_t k = (std::uint64_t{1} << depth) / 3;
    for (const std::size_t axis : {0U, 1U}) {
      EXPECT_EQ(scene.value_at(axis, k, depth), scene.value_at(axis, 2 * k, depth + 1));
      EXPECT_LT(scene.value_at(axis, 2 * k, depth + 1), scene.value_at(axis, 2 * k + 1, depth + 1));
    }
  }
}

TEST(Scene, TakesOtherAxesAndParameters) {
  const ExploredStudy base = explored();
  const Scene scene(base, {{{"omega", 1.1}}, "damping", "x"});
  EXPECT_EQ(scene.study().axes[0].name, "damping");
  EXPECT_TRUE(scene.study().axes[1].is_state);
  const int omega = scene.study().model->find_parameter("omega");
  EXPECT_EQ(scene.study().setting.parameters[static_cast<std::size_t>(omega)], 1.1);
  EXPECT_NE(scene.key(), Scene(base, {}).key());
  EXPECT_EQ(scene.key(), Scene(base, {{{"omega", 1.1}}, "damping", "x"}).key());
}

// An axis in rpm is one of the frequency that follows from it; a torque with a gradual entry of
// teeth stands for two numbers.
TEST(Scene, SweepsWhatFollowsFromAKeyOfADrawing) {
  const std::string gears =
      "[gear]\nteeth = [19, 61]\nmodule_mm = 2.5\nface_width_mm = 25\nbody = 'solid'\n"
      "bearing_stiffness_N_per_mm = 2e5\nbearing_damping_N_s_per_mm = 2\n"
      "mesh_damping_ratio = 0.07\nhalf_backlash_mm = 0.06\ntorque_N_m = 60\n"
      "tooth_entry = 'gradual'\ntransmission_error_um = 5\n[observe]\nquantities = ['dmf_max']\n";
  const Study study = read_study(
      gears + "[[axes]]\nname = 'pinion_speed_rpm'\nfrom = 3000\nto = 6000\ncount = 3\n", "test");
  const Study shown = explorable(study);
  EXPECT_EQ(shown.axes[0].name, "omega");
  EXPECT_DOUBLE_EQ(shown.axes[0].values.back() * study.scales.rpm_per_omega, 6000.0);
  EXPECT_THAT(shown.notices, Contains(HasSubstr("'pinion_speed_rpm' is swept as 'omega'")));
  const Study torques =
      read_study(gears + "[[axes]]\nname = 'torque_N_m'\nfrom = 30\nto = 60\ncount = 3\n", "test");
  EXPECT_THAT([&] { explorable(torques); },
              ThrowsMessage<InputError>(HasSubstr("'torque_N_m' stands for several")));
}

// The first view of a state is as large as motions are, in any unit.
TEST(Scene, ShowsAStateWhereMotionsGo) {
  const auto view_of_x = [](double unit) {
    const Scene scene(
        explored(fmt::format("[model]\nname = 'duffing'\n[parameters]\nlinear = 1.0\ncubic = {}\n"
                             "[[axes]]\nname = 'omega'\nfrom = 0.8\nto = 1.6\ncount = 3\n"
                             "[[axes]]\nname = 'amplitude'\nfrom = {}\nto = {}\ncount = 3\n"
                             "[observe]\nquantities = ['x_max']\n",
                             1.0 / (unit * unit), 0.1 * unit, 0.4 * unit)),
        {{}, "x", "v"});
    return scene.first_view()[0];
  };
  const auto one = view_of_x(1.0), thousand = view_of_x(1e3);
  EXPECT_LT(one[0], -0.2);
  EXPECT_GT(one[1], 0.2);
  EXPECT_LT(one[1] - one[0], 20.0);
  EXPECT_NEAR(thousand[0] / one[0], 1e3, 1.0);
  EXPECT_NEAR(thousand[1] / one[1], 1e3, 1.0);
}

// Also where points start far from where motions go: a neuron at rest begins to fire.
TEST(Scene, ShowsAStateFromWhereItStarts) {
  const Study study = explorable(read_draft("[model]\nname = 'izhikevich'\n", "test.toml"));
  const Scene scene({study, std::nullopt}, {{}, "v", "u"});
  const std::vector<double> start = scene.start();
  for (const std::size_t axis : {0U, 1U}) {
    EXPECT_LT(scene.first_view()[axis][0], start[axis]);
    EXPECT_GT(scene.first_view()[axis][1], start[axis]);
  }
}

// One state moved; the others, and those of other points, start as before.
TEST(Scene, TakesAnotherStart) {
  const std::string text = kExplored + "[initial]\nstate = {x = 0.25, v = -0.5}\n";
  const Scene scene(explored(text), {{{"v", 0.75}}, "", ""});
  EXPECT_THAT(scene.start(), ElementsAre(0.25, 0.75));
  EXPECT_THAT(Scene(explored(text), {}).start(), ElementsAre(0.25, -0.5));
}

TEST(Scene, HasSharesThatAreThoseOfItsValues) {
  const Scene scene(explored(), {});
  for (const std::size_t axis : {0U, 1U}) {
    EXPECT_NEAR(scene.share_of(axis, scene.value_at(axis, 0.3)), 0.3, 1e-14);
  }
}

TEST(Scene, SaysWhatIsWrongWithAChange) {
  const ExploredStudy base = explored();
  const auto expect = [&](const SceneChanges& changes, const std::string& part) {
    EXPECT_THAT([&] { Scene(base, changes); }, ThrowsMessage<InputError>(HasSubstr(part)));
  };
  expect({{{"dampin", 1.0}}, "", ""}, "did you mean 'damping'?");
  expect({{{"omega", -1.0}}, "", ""}, "out of range");
  expect({{}, "nothing", ""}, "neither a parameter nor a state");
  expect({{}, "amplitude", ""}, "amplitude");
}

TEST(Explorable, LeavesOutWhatAPointHasNotAlone) {
  const std::string text =
      kExplored.substr(0, kExplored.find("quantities")) + "quantities = ['poincare', 'x_max']\n";
  const Study study = explorable(read_study(text, "test.toml"));
  ASSERT_EQ(study.selection.quantities.size(), 1U);
  EXPECT_THAT(study.notices, Contains(HasSubstr("poincare")));
  EXPECT_THAT(Scene({study, std::nullopt}, {}).study().notices, Contains(HasSubstr("poincare")));
}

// What an exponent's colours are worth.
TEST(Explorable, AddsTheErrorOfAnExponent) {
  const std::string text =
      kExplored.substr(0, kExplored.find("quantities")) + "quantities = ['lyapunov_max']\n";
  const Study study = explorable(read_study(text, "test.toml"));
  ASSERT_EQ(study.selection.quantities.size(), 2U);
  EXPECT_EQ(study.selection.quantities[1].name, "lyapunov_max_error");
}

TEST(Explorable, SweepsOtherParametersWhereAxesAreMissing) {
  const Study line = explorable(
      read_study("[model]\nname = 'duffing'\n[[axes]]\nname = 'omega'\nvalues = [1.0, 2.0]\n"
                 "[observe]\nquantities = ['poincare']\n",
                 "test.toml"));
  EXPECT_EQ(line.axes[0].name, "omega");
  EXPECT_EQ(line.axes[1].name, "damping");
  EXPECT_EQ(line.selection.quantities[0].name, "motion_class");
  EXPECT_THAT(line.notices, Contains(HasSubstr("'damping' is swept, too")));

  // Where a model has one parameter, a state is the second axis.
  const Study lone = explorable(read_draft("[model]\nname = 'relay'\n", "test.toml"));
  EXPECT_EQ(lone.axes[0].name, "zeta");
  EXPECT_TRUE(lone.axes[1].is_state);

  const Study model = explorable(read_draft("[model]\nname = 'duffing'\n", "test.toml"));
  EXPECT_EQ(model.axes[0].name, "damping");
  EXPECT_EQ(model.axes[1].name, "cubic");
}

TEST(Explorable, RefusesAListOfPoints) {
  const Study list = read_study(
      "[model]\nname = 'duffing'\n[points]\nnames = ['omega']\nnumbers = '''\n1\n2\n'''\n"
      "[observe]\nquantities = ['x_max']\n",
      "test.toml");
  EXPECT_THAT([&] { explorable(list); }, ThrowsMessage<InputError>(HasSubstr("several")));
}

TEST(ViewStudy, IsAStudyOfTheViewWithTheSameStep) {
  const Scene scene(explored(), {});
  const Study study =
      read_study(view_study(scene, {{{0.25, 0.5}, {0.5, 0.75}}, {7, 5}}), "view.toml");
  EXPECT_EQ(study.axes[0].values.size(), 7U);
  EXPECT_EQ(study.axes[0].values.front(), scene.value_at(0, 0.25));
  EXPECT_EQ(study.axes[1].values.back(), scene.value_at(1, 0.75));
  EXPECT_EQ(study.integrate.max_step, scene.study().integrate.max_step);
  EXPECT_EQ(study.integrate.tolerance, 0.0);
  EXPECT_THROW(view_study(scene, {{{0.5, 0.5}, {0.5, 0.75}}, {7, 5}}), InputError);
  EXPECT_THROW(view_study(scene, {{{0.0, 0.0}, {1.0, 1.0}}, {1, 1 << 20}}), InputError);
}

}  // namespace
}  // namespace gearsweep::testing
