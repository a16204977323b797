// The report on gears as built: its numbers against closed forms, and its page.
#include "report/tolerance_report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>

#include "model/error.hpp"
#include "report/detail/scatter.hpp"
#include "report/detail/scatter_page.hpp"
#include "study/new_unit.hpp"
#include "support/folder.hpp"
#include "support/run.hpp"
#include "support/xml.hpp"

namespace gearsweep::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

// The amplitude of a linear oscillator is F/sqrt((1 - w^2)^2 + (2 z w)^2).
const std::string kLinear =
    "title = 'linear'\n[model]\ntext = '''\n[model]\nname = \"linear\"\n[states]\nx = {}\nv = {}\n"
    "[parameters]\nw = {value = 0.5, min = 0.1}\nF = 1.0\nz = 0.1\n[equations]\nx = \"v\"\n"
    "v = \"-2*z*v - x + F*cos(phase)\"\n[forcing]\nperiod = \"2*pi/w\"\n'''\n"
    "[[axes]]\nname = 'w'\nfrom = 0.5\nto = 0.9\ncount = 3\n[integrate]\nmax_step = 0.02\n"
    "[uncertain]\nF = {distribution = 'uniform', from = 0.8, to = 1.2}\n"
    "z = {distribution = 'uniform', from = 0.09, to = 0.11}\n";

double amplitude(double w, double force, double z) {
  return force / std::hypot(1.0 - w * w, 2.0 * z * w);
}

Scatter scatter_of(const std::string& toml, ToleranceOptions options) {
  return find_scatter(read_study(toml, "test.toml"), options).value();
}

TEST(ToleranceReport, ItsPercentilesAreThoseOfTheDraws) {
  ToleranceOptions options;
  options.gears = 400;
  options.percentile = 95.0;
  const Scatter scatter = scatter_of(kLinear, options);
  EXPECT_EQ(scatter.worst, 2U);
  const std::vector<UncertainParameter>& parameters = scatter.study.uncertain.parameters;
  std::vector<double> exact;
  for (std::size_t draw = 0; draw < options.gears; ++draw) {
    exact.push_back(
        amplitude(0.9, parameters[0].draws.values[draw], parameters[1].draws.values[draw]));
  }
  const Percentile expected = percentile_with_error(exact, 95.0);
  EXPECT_NEAR(scatter.percentiles[2].value, expected.value, 1e-3);
  EXPECT_NEAR(scatter.percentiles[2].error, expected.error, 1e-3);
  // The worst gear is the draw with the largest of these.
  const auto worst = std::ranges::max_element(exact);
  EXPECT_EQ(scatter.worst_gears.front().draw, static_cast<std::size_t>(worst - exact.begin()));
  EXPECT_NEAR(scatter.worst_gears.front().value, *worst, 1e-3);
}

// The variance of a product of two factors is nearly that of the wider one; half as wide, it leaves
// a percentile that the closed form gives.
TEST(ToleranceReport, RanksTolerancesByWhatTheyMake) {
  ToleranceOptions options;
  options.gears = 1000;
  const Scatter scatter = scatter_of(kLinear, options);
  ASSERT_EQ(scatter.ranking.size(), 2U);
  const RankedTolerance& force = scatter.ranking[0];
  const RankedTolerance& damping = scatter.ranking[1];
  EXPECT_EQ(force.name, "F");
  // By the closed form, with 2e6 draws.
  EXPECT_NEAR(force.total, 0.947, 0.1);
  EXPECT_NEAR(damping.total, 0.0535, 0.02);
  std::vector<double> tightened;
  const std::vector<UncertainParameter>& parameters = scatter.study.uncertain.parameters;
  for (std::size_t draw = 0; draw < options.gears; ++draw) {
    tightened.push_back(amplitude(0.9, 1.0 + 0.5 * (parameters[0].draws.values[draw] - 1.0),
                                  parameters[1].draws.values[draw]));
  }
  EXPECT_NEAR(force.tightened.value(), percentile_with_error(tightened, 99.0).value, 1e-3);
}

// The interval of a percentile of n independent numbers holds the true one in 95 of 100 cases.
TEST(ToleranceReport, ItsErrorIsWhatRepetitionsShow) {
  constexpr int kTrials = 400, kNumbers = 500;
  std::uint64_t state = 1;
  int held = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    std::vector<double> numbers;
    for (int i = 0; i < kNumbers; ++i) {
      state = state * 6364136223846793005U + 1442695040888963407U;  // Knuth's MMIX
      numbers.push_back(static_cast<double>(state >> 11U) * 0x1p-53);
    }
    const Percentile one = percentile_with_error(numbers, 90.0);
    if (std::abs(one.value - 0.9) <= one.error) ++held;
  }
  EXPECT_NEAR(static_cast<double>(held) / kTrials, 0.95, 0.04);
}

TEST(ToleranceReport, DrawsMoreGearsUntilTheValueIsKnown) {
  ToleranceOptions options;
  options.gears = 50;
  options.width = 0.02;
  const Scatter scatter = scatter_of(kLinear, options);
  EXPECT_GT(scatter.gears(), 50U);
  const Percentile& worst = scatter.percentiles[scatter.worst];
  EXPECT_LE(worst.error, 0.02 * worst.value);
}

const std::string kGears =
    "title = 'A <gear> & more'\n[model]\nname = 'gear5'\n[gear]\nteeth = [19, 61]\nmodule_mm = "
    "2.5\nbody = 'solid'\nface_width_mm = 25\nbearing_stiffness_N_per_mm = 200000\n"
    "bearing_damping_N_s_per_mm = 2\nmesh_damping_ratio = 0.07\nhalf_backlash_mm = 0.0625\n"
    "torque_N_m = 59\ntransmission_error_um = 5\n[[axes]]\nname = 'pinion_speed_rpm'\nfrom = "
    "14000\nto = 18000\ncount = 3\n";

TEST(ToleranceReport, IsAPageWithGearsThatRun) {
  const Folder folder;
  ToleranceOptions options;
  options.gears = 20;
  options.worst_folder = folder / "worst";
  const std::string path = folder / "built.html";
  ASSERT_TRUE(write_tolerance_report(read_study(kGears, "gears.toml"), path, options));
  const std::string page = read_all(path);
  EXPECT_EQ(malformed(page), "");
  for (const char* part :
       {"A &lt;gear&gt; &amp; more: gears as built", "Of 20 gears as built",
        "Which tolerance to tighten", "The worst gears", "ISO 1328-1 class 7", "half as wide"}) {
    EXPECT_THAT(page, HasSubstr(part));
  }
  const Scatter scatter = scatter_of(kGears, options);
  const SweepResult worst = run(read_all(options.worst_folder + "/gear-01.toml"));
  EXPECT_NEAR(map_of(worst, scatter.target)[scatter.worst_gears.front().point],
              scatter.worst_gears.front().value, 2e-3);
}

// Gears of several meshes are judged by the first, which the page names.
TEST(ToleranceReport, OfSeveralMeshesNamesThem) {
  const NewUnit idler = {GearArrangement::idler, {19, 33, 61}, {2.5, 2.5}, {25.0, 25.0}, {}, 59.0};
  ToleranceOptions options;
  options.gears = 12;
  options.command_line = "gearsweep tolerance";
  const Study study = read_study(new_unit_study(idler), "idler.toml",
                                 {"axes.0.count=2", "integrate.settle=30", "integrate.record=8"});
  const Scatter scatter = find_scatter(study, options).value();
  const std::string html = scatter_page(scatter, options).text();
  EXPECT_EQ(malformed(html), "");
  EXPECT_THAT(html, AllOf(HasSubstr("have a dynamic load factor of the first mesh of at most"),
                          HasSubstr("largest force of the second mesh"),
                          HasSubstr("second: transmission error <span"),
                          HasSubstr("first: stiffness factor <span"),
                          HasSubstr("lose contact at some speed")));
  // Teeth part where they do in any mesh, at any of the speeds.
  std::set<std::size_t> parting;
  for (const char* contact : {"first_contact_class", "second_contact_class"}) {
    for (const std::vector<double>& row : draws_of_points(scatter.result, contact)) {
      for (std::size_t draw = 0; draw < row.size(); ++draw) {
        if (row[draw] == 1.0 || row[draw] == 2.0) parting.insert(draw);
      }
    }
  }
  EXPECT_DOUBLE_EQ(scatter.parting_anywhere, static_cast<double>(parting.size()) / 12.0);
  EXPECT_GT(parting.size(), 0U);
}

// Numbers for programs are those of the draws, whose closed form is known, each with its unit.
TEST(ToleranceReport, TellsProgramsWhatThePageSays) {
  const Folder folder;
  ToleranceOptions options;
  options.gears = 100;
  options.percentile = 90.0;
  options.json_path = folder / "findings.json";
  ASSERT_TRUE(write_tolerance_report(read_study(kLinear, "test.toml"), "", options));
  const nlohmann::json found = nlohmann::json::parse(read_all(options.json_path));
  const Scatter scatter = scatter_of(kLinear, options);
  const std::vector<UncertainParameter>& parameters = scatter.study.uncertain.parameters;
  ASSERT_EQ(found["speeds"].size(), 3U);
  for (const nlohmann::json& one : found["speeds"]) {
    std::vector<double> exact;
    for (std::size_t draw = 0; draw < options.gears; ++draw) {
      exact.push_back(amplitude(one["speed"], parameters[0].draws.values[draw],
                                parameters[1].draws.values[draw]));
    }
    const Percentile expected = percentile_with_error(exact, 90.0);
    EXPECT_NEAR(one["percentile"], expected.value, 1e-3);  // sampled at the steps
    EXPECT_NEAR(one["error"], expected.error, 1e-3);
    EXPECT_NEAR(one["nominal"], amplitude(one["speed"], 1.0, 0.1), 1e-3);
  }
  EXPECT_EQ(found["worst"], found["speeds"][2]);
  EXPECT_EQ(found["bands"]["x_max"]["percentiles"][2]["values"][1],
            found["speeds"][1]["percentile"]);
  EXPECT_EQ(found["ranking"][0]["tolerance"], "F");
  const nlohmann::json& worst = found["worst_gears"][0];
  EXPECT_NEAR(
      worst["value"],
      amplitude(worst["speed"], worst["parameters"][0]["value"], worst["parameters"][1]["value"]),
      1e-3);
}

TEST(ToleranceReport, TellsProgramsInTheUnitsOfThePage) {
  ToleranceOptions options;
  options.gears = 20;
  const Study study = read_study(kGears, "gears.toml");
  const nlohmann::json found = nlohmann::json::parse(tolerance_findings(study, options).value());
  EXPECT_EQ(found["speed"]["unit"], "rpm");
  EXPECT_EQ(found["speeds"][1]["speed"], 16000.0);
  EXPECT_EQ(found["bands"]["dmf_max"]["unit"], "N");
  EXPECT_EQ(found["bands"]["dte_peak_to_peak"]["unit"], "µm");
  // Load factor and force are in proportion: the load of the nominal gear is T/Rp, 59 N m over the
  // base radius of 19 teeth.
  const double load = 59.0 / (0.5 * 19 * 2.5e-3 * std::cos(20.0 * std::numbers::pi / 180.0));
  EXPECT_NEAR(found["bands"]["dmf_max"]["nominal"][0].get<double>() / load,
              found["speeds"][0]["nominal"], 1e-9);
  EXPECT_TRUE(found["speeds"][0]["error"].is_null());  // 20 gears do not know their percentile 99
  EXPECT_EQ(found["assumed"].size(), found["ranking"].size());
}

// Gears that have no value are told, and a speed at which all diverge is not the worst.
TEST(ToleranceReport, TellsOfGearsWithoutAValue) {
  ToleranceOptions options;
  options.gears = 40;
  const Scatter scatter = scatter_of(
      "[model]\ntext = '''\n[model]\nname = \"grows\"\ndiverged_above = 1e3\n[states]\nx = {}\n"
      "v = {}\n[parameters]\nw = {value = 0.5, min = 0.1}\nz = 0.1\n[equations]\nx = \"v\"\n"
      "v = \"-2*z*v - x + cos(phase)\"\n[forcing]\nperiod = \"2*pi/w\"\n'''\n[[axes]]\nname = 'w'\n"
      "from = 0.5\nto = 0.7\ncount = 2\n[integrate]\nmax_step = 0.02\n[uncertain]\n"
      "z = {values = [0.1, -0.1]}\n",
      options);
  const std::vector<double>& damping = scatter.study.uncertain.parameters.front().draws.values;
  EXPECT_EQ(scatter.without_value, static_cast<std::size_t>(std::ranges::count(damping, -0.1)));
  EXPECT_GT(scatter.without_value, 0U);
  EXPECT_NEAR(scatter.percentiles[1].value, amplitude(0.7, 1.0, 0.1), 1e-3);
  EXPECT_THAT(scatter_page(scatter, options).text(), HasSubstr("have no value at some speed"));
}

TEST(ToleranceReport, SaysWhatItNeeds) {
  const ToleranceOptions options;
  const auto write = [&](const std::string& toml) {
    return [&options, toml] {
      write_tolerance_report(read_study(toml, "test.toml"), "/tmp/never.html", options);
    };
  };
  EXPECT_THAT(write("[model]\npreset = 'coarse'\n[[axes]]\nname = 'omega'\nfrom = 0.5\nto = 1.0\n"
                    "count = 3\n"),
              ThrowsMessage<InputError>(HasSubstr("[uncertain] table")));
  EXPECT_THAT(write(kGears + "[[axes]]\nname = 'mu'\nfrom = 0.01\nto = 0.1\ncount = 3\n"),
              ThrowsMessage<InputError>(HasSubstr("two axes")));
  const std::string points = "[points]\nnames = ['torque_N_m']\nnumbers = '''\n20\n61\n'''\n";
  const std::string drawing = kGears.substr(0, kGears.find("[[axes]]"));
  EXPECT_THAT(write(drawing + points), ThrowsMessage<InputError>(HasSubstr("leave out [points]")));
  EXPECT_THAT(write(kGears + points), ThrowsMessage<InputError>(HasSubstr("leave out [points]")));
}

}  // namespace
}  // namespace gearsweep::testing
