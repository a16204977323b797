// Which curves are taken for a map, and what the service says of them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>

#include "borders/border_search.hpp"
#include "explore/curve_messages.hpp"
#include "explore/explored.hpp"
#include "explore/explored_curves.hpp"
#include "explore/explorer.hpp"
#include "explore/linear_curves.hpp"
#include "model/error.hpp"
#include "plan/passive_states.hpp"
#include "result/border_file.hpp"
#include "result/border_plane.hpp"

namespace gearsweep::testing {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

std::string with(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

TEST(ExploredCurves, AreThoseOfTheMapsPlane) {
  const Folder folder;
  const std::string path = write_linear_curves(folder);
  const auto refusal = [&](const std::string& text) -> std::string {
    try {
      read_explored_curves(path, explored(text).study);
      return "";
    } catch (const InputError& error) {
      return error.what();
    }
  };
  EXPECT_EQ(refusal(kLinear), "");
  // Other values of the axes, another start and other quantities have the same curves.
  EXPECT_EQ(refusal(with(kLinear, "from = 0.8", "from = 0.5")), "");
  EXPECT_EQ(refusal(with(kLinear, "'x_max', 'period'", "'v_max'") +
                    "[initial]\npolicy = 'fixed'\nstate = { x = 1.0 }\n"),
            "");
  EXPECT_THAT(
      refusal(with(kLinear, "damping = 0.2", "damping = 0.25")),
      HasSubstr("curves.nc: its curves are of damping = 0.2, the map is of damping = 0.25"));
  EXPECT_THAT(refusal(with(kLinear, "'amplitude'\nfrom", "'linear'\nfrom")),
              HasSubstr("over omega and amplitude, the map is over omega and linear"));
  EXPECT_THAT(refusal("[model]\nname = 'pendulum'\n[[axes]]\nname = 'omega'\nfrom = 0.5\nto = 1\n"
                      "count = 3\n[observe]\nquantities = ['period']\n"),
              HasSubstr("of the model duffing, the map is of the model pendulum"));
}

TEST(ExploredCurves, OfNoCurvesOrOtherNumbersAreRefused) {
  const Folder folder;
  EXPECT_EQ(read_borders(write_linear_curves(folder)).curves.size(), 2U);
  for (const Damage damage : {Damage::no_place, Damage::no_state, Damage::no_period}) {
    EXPECT_THROW(read_borders(write_linear_curves(folder, damage)), InputError);
  }
  EXPECT_TRUE(read_borders(write_linear_curves(folder, Damage::no_curves)).curves.empty());
}

// A file of one flip of the coarse gear; search: the study with the model that it is of.
std::string write_gear_curves(const Folder& folder, const Study& search) {
  BorderFindings findings;
  findings.study = search;
  findings.steps = 256;
  findings.ranges = {1.0, 1.0};
  BorderCurve flip;
  flip.kind = BorderKind::flip;
  const auto states = static_cast<Eigen::Index>(search.model->states.size());
  for (const double omega : {1.0, 1.1}) {
    BorderPoint point;
    point.place = {omega, 0.9};
    point.state = Eigen::VectorXd::LinSpaced(states, 0.01, 0.02);
    point.multipliers = Eigen::VectorXcd::Constant(states, 0.5);
    flip.points.push_back(point);
  }
  findings.curves = {flip};
  const std::string path = folder / "gear.nc";
  write_borders(findings, path, {});
  return path;
}

// A search leaves out the shafts that mirror others and what drives nothing; a trace has all.
TEST(ExploredCurves, HaveTheStatesOfASearchAndOfItsMirror) {
  const Folder folder;
  const std::string text =
      "[model]\nname = 'gear5'\npreset = 'coarse'\n"
      "[[axes]]\nname = 'omega'\nfrom = 0.8\nto = 1.2\ncount = 3\n"
      "[[axes]]\nname = 'b'\nfrom = 0.8\nto = 1.2\ncount = 3\n[observe]\nquantities = ['period']\n";
  Study study = read_study(text, "test.toml");
  study.separate_points();
  const ExploredStudy base = explored(text);
  EXPECT_THROW(read_explored_curves(write_gear_curves(folder, study), base.study), InputError);
  const std::string path = write_gear_curves(folder, without_passive_states(study));
  Explorer explorer(base, {.source = "test",
                           .is_model = false,
                           .devices = {},
                           .curves = read_explored_curves(path, base.study)});
  const BorderMotion border = explorer.border(*explorer.make_scene({}), {0, 1});
  std::map<std::string, double> start;
  for (const NamedValue& state : border.start) start[state.name] = state.value;
  EXPECT_EQ(start.size(), 6U);
  EXPECT_NE(start.at("x3"), 0.0);
  EXPECT_EQ(start.at("x5"), -start.at("x3"));
  EXPECT_EQ(start.at("v5"), -start.at("v3"));
  ASSERT_TRUE(border.motion.trace);
  for (const auto& [name, value] : start) {
    const int state = study.model->find_state(name);
    EXPECT_EQ(border.motion.trace->values[static_cast<std::size_t>(state)].front(), value) << name;
  }
  EXPECT_THAT(border.motion.notes.back(), HasSubstr("x2, x4, v2, v4 drive nothing"));
  EXPECT_GT(border.gap, 1e-3);  // what this file has is no orbit
}

// Functions of the phase are no numbers of a setting.
TEST(PlaneDifference, IsAlsoInTables) {
  const Folder folder;
  const auto study = [&](const std::string& table) {
    folder.write("stiffness.csv", table);
    const std::string curves =
        "[model.curves]\nmeasured_stiffness = '" + (folder / "stiffness.csv").string() + "'\n";
    return read_study("[model]\nname = 'gear5'\nstiffness = 'table'\n" +
                          (table.empty() ? "" : curves) +
                          "[[axes]]\nname = 'omega'\nfrom = 0.5\nto = 1.0\ncount = 2\n"
                          "[[axes]]\nname = 'b'\nfrom = 0.5\nto = 1.0\ncount = 2\n"
                          "[observe]\nquantities = ['period']\n",
                      "test.toml");
  };
  const std::string table = "0, 1\n1, 1.2\n3, 0.9\n5, 0.8\n";
  const Study one = study(table);
  EXPECT_FALSE(plane_difference(one, study(table)));
  const auto other = plane_difference(one, study(with(table, "1.2", "1.3")));
  ASSERT_TRUE(other);
  EXPECT_EQ(other->of_curves, "of a 'measured_stiffness' of their own");
  EXPECT_EQ(other->of_map, "of another");
}

class CurveMessages : public ::testing::Test {
 protected:
  json border(const SceneChanges& changes, const CurvePlace& place) {
    const auto scene = explorer_.make_scene(changes);
    return json::parse(border_message(explorer_, *scene, explorer_.border(*scene, place)));
  }

  Folder folder_;
  ExploredStudy base_ = explored(kLinear);
  Explorer explorer_{base_,
                     {.source = "test",
                      .is_model = false,
                      .devices = {},
                      .curves = read_explored_curves(write_linear_curves(folder_), base_.study)}};
};

TEST_F(CurveMessages, TellsTheCurvesAsTheyStandInTheFile) {
  const json curves = json::parse(curves_message(*explorer_.curves()));
  EXPECT_EQ(curves.at("x"), "omega");
  EXPECT_EQ(curves.at("y"), "amplitude");
  ASSERT_EQ(curves.at("styles").size(), 2U);  // of the kinds that there are
  EXPECT_EQ(curves.at("styles")[0].at("kind"), "fold");
  EXPECT_EQ(curves.at("styles")[0].at("dashes").size(), 0U);
  EXPECT_EQ(curves.at("styles")[1].at("kind"), "Neimark-Sacker");
  EXPECT_EQ(curves.at("styles")[1].at("dashes").size(), 2U);
  const json& fold = curves.at("curves")[0];
  EXPECT_EQ(fold.at("kind"), "fold");
  EXPECT_EQ(fold.at("x"), json({0.9, 1.0, 1.1, 1.2, 1.3}));
  EXPECT_EQ(fold.at("stretches"), json({{0, 2, true}, {2, 4, false}}));
  EXPECT_EQ(curves.at("curves")[1].at("period"), 2);
}

// The closed form knows nothing of steps: the trace goes as it says, and returns.
TEST_F(CurveMessages, OpensTheOrbitAtAPointFromTheFilesState) {
  const json told = border({}, {0, 2});
  EXPECT_THAT(told.at("label").get<std::string>(),
              HasSubstr("fold of period 1 at omega=1.1, amplitude=0.2"));
  const json facts = told.at("values");
  const auto fact = [&](const std::string& name) -> std::string {
    for (const json& one : facts) {
      if (one.at("name") == name) return one.at("text");
    }
    return "";
  };
  EXPECT_EQ(fact("bifurcation"), "fold");
  EXPECT_EQ(fact("period"), "1 period of the forcing");
  EXPECT_EQ(std::stod(fact("residual")), 1e-12 * 1.1);
  EXPECT_THAT(fact("error of steps"), HasSubstr("0.12 pixels"));
  EXPECT_THAT(fact("stable"), HasSubstr("yes"));
  const std::complex<double> multiplier = linear_multiplier(1.1);
  EXPECT_EQ(told.at("multipliers").at("values")[0], json({multiplier.real(), multiplier.imag()}));
  const auto x = told.at("series")[0].get<std::vector<double>>();
  const auto tau = told.at("tau").get<std::vector<double>>();
  EXPECT_EQ(x[0], response(1.1, 0.2).imag());
  EXPECT_NEAR(tau.back(), 2.0 * std::numbers::pi / 1.1, 1e-12);
  // Fourth order with 512 steps; what is between them is a cubic.
  for (std::size_t i = 0; i < x.size(); ++i) {
    const std::complex<double> turned = std::polar(1.0, 1.1 * tau[i]);
    ASSERT_NEAR(x[i], (response(1.1, 0.2) * turned).imag(), 1e-8) << i;
  }
  const std::string command = told.at("commands")[0];
  EXPECT_THAT(command, HasSubstr("gearsweep trace test --set 'initial={policy = \"fixed\", state"));
  EXPECT_THAT(command, HasSubstr("--set integrate.steps_per_period=512"));
  EXPECT_THAT(command, HasSubstr("--settle 0 --record 1"));
}

TEST_F(CurveMessages, HasNoNumbersForWhatIsNotKnown) {
  const json told = border({{}, "amplitude", "omega"}, {1, 1});
  EXPECT_TRUE(told.at("multipliers").at("values")[1][0].is_null());
  EXPECT_THAT(told.at("values").dump(), HasSubstr("not known"));
  EXPECT_EQ(told.at("at")[0], json({{"name", "amplitude"}, {"value", 0.3}}));
  // Two periods of the forcing, of the same orbit.
  const auto tau = told.at("tau").get<std::vector<double>>();
  EXPECT_NEAR(tau.back(), 2.0 * 2.0 * std::numbers::pi / 1.4, 1e-12);
  const auto x = told.at("series")[0].get<std::vector<double>>();
  EXPECT_NEAR(x.back(), x.front(), 1e-8);
  EXPECT_EQ(told.at("section").at("points").size(), 3U);
}

}  // namespace
}  // namespace gearsweep::testing
