// Quantities are called what the model says of their signals, and equal parts are shown once.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "report/detail/words.hpp"
#include "report/report.hpp"
#include "study/builtin_models.hpp"
#include "study/study.hpp"
#include "support/folder.hpp"
#include "support/xml.hpp"

namespace gearsweep {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(ReportWords, AreThoseOfTheModelsSignals) {
  const Model& planetary = *find_model("planetary");
  const auto words = [&](const std::string& name, int alike = 1) {
    return words_html(planetary, name, alike);
  };
  EXPECT_EQ(words("dmf_s1_max"), "largest force of sun and planet 1");
  EXPECT_EQ(words("dmf_s1_max", 3), "largest force of sun and planets 1 to 3");
  EXPECT_EQ(words("dmf_r2_std"), "standard deviation of the force of planet 2 and ring");
  EXPECT_EQ(words("dmf_r1_dynamic_load_factor", 3),
            "dynamic load factor of planets 1 to 3 and ring");
  EXPECT_EQ(words("ring1_contact_gap"), "share of time without contact of planet 1 and ring");
  EXPECT_EQ(words("bearing_sun_max"), "largest force on the bearing of the sun");
  EXPECT_EQ(words("dmf_s1_order_2_amplitude"), "order 2 of the force of sun and planet 1");
  // These have their words in every picture.
  EXPECT_EQ(words("dte_peak_to_peak"), "range of transmission error");
  EXPECT_EQ(words_html(*find_model("gear5"), "dmf_max"), "largest meshing force");
  const Model& stages = *find_model("two_stages");
  EXPECT_EQ(words_html(stages, "dmf2_max"), "largest force of the second mesh");
  EXPECT_EQ(contact_words(stages, "second"), "the second mesh");
}

TEST(ReportWords, TellEqualPartsFromOthers) {
  const Model& planetary = *find_model("planetary");
  const Model& stages = *find_model("two_stages");
  const auto are_equal = [](const Model& model, const std::string& a, const std::string& b) {
    return are_of_equal_parts(model, numbered(a).value(), numbered(b).value());
  };
  EXPECT_TRUE(are_equal(planetary, "dmf_s1_max", "dmf_s3_max"));
  EXPECT_TRUE(are_equal(planetary, "sun1_contact_gap", "sun2_contact_gap"));
  EXPECT_FALSE(are_equal(planetary, "dmf_s1_max", "dmf_r2_max"));
  EXPECT_FALSE(are_equal(planetary, "dmf_s1_max", "dmf_s2_std"));
  EXPECT_FALSE(are_equal(stages, "dmf1_max", "dmf2_max"));  // the first mesh and the second
  EXPECT_FALSE(numbered("dmf_max"));
}

// Two oscillators of one kind, each shaken by an error of its own.
std::string page_of_twins(double first_error, double second_error) {
  constexpr const char* kTwins = R"(
[model]
text = """
[model]
name = 'twins'
[states]
x1 = {{ start = 1.1 }}
v1 = {{}}
x2 = {{ start = 1.1 }}
v2 = {{}}
[parameters]
omega = {{ value = 0.7, min = 0.1, max = 10 }}
load = {{ value = 0.1, min = 0, max = 1, role = 'load' }}
e1 = {}
e2 = {}
[forcing]
period = '2*pi/omega'
[constants]
wheel1 = 'backlash(x1, 1)'
wheel2 = 'backlash(x2, 1)'
[equations]
x1 = 'v1'
v1 = 'load - wheel1 - 0.1*v1 + e1*sin(phase)'
x2 = 'v2'
v2 = 'load - wheel2 - 0.1*v2 + e2*sin(phase)'
[signals.push1]
expression = 'wheel1'
role = 'mesh_force'
load = 'load'
meaning = 'force of wheel 1, without damping'
[signals.push2]
expression = 'wheel2'
role = 'mesh_force'
load = 'load'
meaning = 'force of wheel 2, without damping'
"""
[[axes]]
name = 'omega'
from = 0.5
to = 0.7
count = 3
[integrate]
settle = 30
record = 10
)";
  const Study study = read_study(fmt::format(kTwins, first_error, second_error), "twins.toml");
  const testing::Folder folder;
  ReportOptions options;
  options.command_line = "gearsweep report";
  EXPECT_TRUE(write_report({{study, ""}}, folder / "report.html", options));
  std::string html = testing::read_all(folder / "report.html");
  EXPECT_EQ(malformed(html), "");
  return html;
}

TEST(Report, ShowsEqualPartsOnce) {
  const std::string html = page_of_twins(0.02, 0.02);
  EXPECT_THAT(html, AllOf(HasSubstr("largest force of wheels 1 to 2 <span class=\"raw\">push1_max "
                                    "to push2_max</span>"),
                          HasSubstr(": the largest force of wheels 1 to 2 is "),
                          HasSubstr("share of time without contact of wheels 1 to 2"),
                          Not(HasSubstr("force of wheel 2")), Not(HasSubstr("largest push1")),
                          Not(HasSubstr("shown as one, by the first"))));
}

// Six in a hundred more: one is not shown for the other.
TEST(Report, ShowsUnequalPartsEachByItself) {
  const std::string html = page_of_twins(0.05, 0.08);
  EXPECT_THAT(html,
              AllOf(HasSubstr("largest force of wheel 1 <span class=\"raw\">push1_max</span>"),
                    HasSubstr("largest force of wheel 2 <span class=\"raw\">push2_max</span>"),
                    HasSubstr(": the largest force of wheel 2 is "),
                    Not(HasSubstr("Largest force of wheels"))));
}

// As much as what is not periodic leaves to chance: the page says so.
TEST(Report, SaysHowFarPartsThatAreShownAsOneDiffer) {
  const std::string html = page_of_twins(0.02, 0.0202);
  EXPECT_THAT(html, AllOf(HasSubstr("largest force of wheels 1 to 2"),
                          HasSubstr("Equal parts are shown as one, by the first of them.")));
}

}  // namespace
}  // namespace gearsweep
