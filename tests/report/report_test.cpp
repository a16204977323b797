// The report of a gear: it has its sections, it is well-formed, and what is text in it stays text.
#include "report/report.hpp"

#include <gmock/gmock.h>

#include <regex>

#include "model/error.hpp"
#include "report/detail/findings.hpp"
#include "report/detail/html.hpp"
#include "result/study_source.hpp"
#include "support/folder.hpp"
#include "support/xml.hpp"

namespace gearsweep {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

// RFC 4648.
std::string from_base64(const std::string& text) {
  const std::string letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned group = 0, count = 0;
  for (const char letter : text) {
    const std::size_t value = letters.find(letter);
    if (value == std::string::npos) break;
    group = (group << 6U) | static_cast<unsigned>(value);
    if (++count % 4 != 1)
      bytes += static_cast<char>((group >> (6U - 2U * ((count - 1) % 4))) & 255U);
  }
  return bytes;
}

// The numbers at the axes of the picture with this caption: the texts of its SVG.
std::vector<std::string> tics_of_figure(const std::string& html, const std::string& caption) {
  const std::size_t at = html.find("alt=\"" + caption);
  if (at == std::string::npos) return {"no such picture"};
  const std::size_t begin = html.find("base64,", at) + 7;
  const std::string svg = from_base64(html.substr(begin, html.find('"', begin) - begin));
  static const std::regex kNumber("<tspan[^>]*>(\\s*[-0-9.]+)</tspan>|>\\s*([-0-9.]+)\\s*</t");
  std::vector<std::string> tics;
  for (std::sregex_iterator one(svg.begin(), svg.end(), kNumber), end; one != end; ++one) {
    tics.push_back(one->str());
  }
  return tics;
}

std::string report_of(const ReportStudies& studies) {
  const testing::Folder folder;
  ReportOptions options;
  options.command_line = "gearsweep report";
  EXPECT_TRUE(write_report(studies, folder / "report.html", options));
  EXPECT_EQ(folder.files(), std::set<std::string>{"report.html"});
  return testing::read_all(folder / "report.html");
}

std::string report_of(const Study& study) { return report_of(ReportStudies{{study, ""}}); }

const std::vector<std::string>& small() {
  static const std::vector<std::string> kSmall = {"axes.omega.count=12", "axes.mu.count=3",
                                                  "integrate.settle=30", "integrate.record=10",
                                                  "integrate.stop=never"};
  return kSmall;
}

TEST(Report, OfAGearHasEachSection) {
  const std::string html = report_of(find_study("table1-gear", small()));
  EXPECT_EQ(malformed(html), "");
  for (const char* section : {"Worst speeds", "Natural frequencies and critical speeds",
                              "Over the speed: force, contact, orders, run-up and run-down",
                              "What was given, and what was assumed"}) {
    EXPECT_THAT(html, HasSubstr(std::string("<h2>") + section + "</h2>"));
  }
  // The closed form of test_orders, in units of varpi = sqrt(k0/me) = 24896 rad/s.
  for (const char* mode : {"1933 Hz", "2757 Hz", "5652 Hz"}) EXPECT_THAT(html, HasSubstr(mode));
  // What an engineer reads has no expressions of the program's.
  EXPECT_THAT(html, Not(HasSubstr("tabulated")));
}

// The stiffness after an entry by that before, of the pairs' parabola: kappa(0) + kappa(1) over
// kappa(1) with kappa(s) = 1 - q ((s - eps/2)/(eps/2))^2. A sum of cosines does not jump.
TEST(Report, KnowsHowFarTheForceJumpsAtAnySpeed) {
  const Study gear = find_study("table1-gear", {"axes.mu.from=0", "parameters.q=0.35"});
  ModelSetting setting = gear.setting;
  const auto mu = static_cast<std::size_t>(gear.model->find_parameter("mu"));
  setting.parameters[mu] = 0.0;
  const double eps = 1.718, pitch = 2.0 / eps - 1.0;
  const double after = 1.0 - 0.35 * pitch * pitch;
  EXPECT_NEAR(static_jump(*gear.model, setting), (0.65 + after) / after, 1e-12);
  const Study smooth = read_study(
      "[model]\nname = 'gear1'\n[[axes]]\nname = 'omega'\nvalues = [0.6, 0.7]\n", "test");
  EXPECT_EQ(static_jump(*smooth.model, smooth.setting), 1.0);
}

// Without any error the slowest speed has the factor of the jump, and no vibration: it leads no
// list of worst speeds.
TEST(Report, DoesNotTakeTheJumpForAResonance) {
  std::vector<std::string> changes = small();
  changes.insert(changes.end(), {"axes.omega.from=0.02", "axes.omega.to=0.12",
                                 "gear.transmission_error_um=0", "model.backlash=\"constant\""});
  const std::string html = report_of(find_study("table1-gear", changes));
  EXPECT_THAT(html, HasSubstr("about 1.63 times the mean load is there at any speed"));
  EXPECT_THAT(html, HasSubstr("Peaks of the standard deviation of meshing force"));
  const std::string worst = html.substr(html.find("<h2>Worst speeds</h2>"));
  EXPECT_THAT(worst.substr(0, worst.find("</table>")), Not(HasSubstr("<th>119 rpm")));
}

TEST(Report, OfAModelWithoutScalesIsInItsOwnUnits) {
  const Study study = read_study(
      "title = 'a <b> & c'\n"
      "[model]\nname = 'gear1'\n[[axes]]\nname = 'omega'\nfrom = 0.6\nto = 1.1\ncount = 8\n"
      "[integrate]\nsettle = 30\nrecord = 10\nstop = 'never'\n[observe]\nquantities = ['x_rms']\n",
      "test");
  const std::string html = report_of(study);
  EXPECT_EQ(malformed(html), "");
  EXPECT_THAT(html, HasSubstr("<h1>a &lt;b&gt; &amp; c</h1>"));
  EXPECT_THAT(html, Not(HasSubstr("rpm")));
}

// Only of a pair whose deviations are known.
TEST(Report, OfAPairWithDeviationsHasTheDynamicFactorOfTheStandard) {
  std::vector<std::string> changes = small();
  changes.insert(changes.end(), {"gear.face_width_mm=20", "gear.pitch_deviation_um=8",
                                 "gear.profile_form_deviation_um=9"});
  const Study study = find_study("table1-gear", changes);
  const std::string html = report_of(study);
  EXPECT_EQ(malformed(html), "");
  EXPECT_THAT(html, HasSubstr("<td>K<sub>v</sub>, ISO 6336-1 method B</td>"));
  EXPECT_THAT(html, Not(HasSubstr("<code>pitch_deviation_um</code>")));
  // In the main resonance it does not depend on the speed: 61.3 N m at 60 mm over 20 mm are 51
  // N/mm, c_gamma = 10.87 and c' = 10.87/(0.75 1.718 + 0.25) N/(mm um), and so
  // 1 + 0.32 c' 7.4/F + 0.34 c' 8.325/F + 0.9.
  EXPECT_THAT(html, HasSubstr("<td>2.619</td>"));
  EXPECT_THAT(report_of(find_study("table1-gear", small())),
              HasSubstr("<code>pitch_deviation_um</code>"));
}

// A model of one's own, whose drawing has a name: the numbers of a bare [gear], in rpm and N.
TEST(Report, OfANamedDrawingIsInItsUnitsAndHasItsDynamicFactor) {
  const std::string study =
      "[model]\ntext = '''\n[model]\nname = \"mesh\"\n[drawings]\nfirst = \"the pair\"\n"
      "[states]\nx = { unit = \"b_n\", start = \"1 + F1_first\" }\nv = { unit = \"b_n varpi\" }\n"
      "[parameters]\nomega = { value = 0.7, min = 0.01, max = 10, unit = \"varpi\" }\n"
      "F1_first = { value = 0.1, unit = \"k0 b_n\", role = \"load\" }\ne0_first = 0.2\n"
      "zeta_first = 0.04\neps_first = { value = 1.7, min = 1.001, max = 1.999 }\n[constants]\nf = "
      "\"(1 + 0.2*cos(phase))*backlash(x, 1)\"\n"
      "[equations]\nx = \"v\"\nv = \"F1_first - 2*zeta_first*v - f + "
      "e0_first*omega^2*sin(phase)\"\n[forcing]\nperiod = \"2*pi/omega\"\n"
      "[signals]\npush = { expression = \"f\", unit = \"k0 b_n\", role = \"mesh_force\" }\n"
      "pairs = \"eps_first\"\n'''\n"
      "[gear.first]\nteeth = [40, 40]\nmodule_mm = 3\ncontact_ratio = 1.718\ninertia_kg_mm2 = "
      "2230\n"
      "half_backlash_mm = 0.05\nmesh_stiffness_N_per_m = 2.174e8\nmesh_damping_N_s_per_mm = 0.7\n"
      "torque_N_m = 61.3\ntransmission_error_um = 10\nface_width_mm = 20\n"
      "pitch_deviation_um = 8\nprofile_form_deviation_um = 9\n"
      "[[axes]]\nname = 'omega'\nfrom = 0.6\nto = 1.1\ncount = 9\n"
      "[integrate]\nsettle = 30\nrecord = 10\nstop = 'never'\nmax_step = 0.05\n";
  const std::string html = report_of(read_study(study, "test"));
  EXPECT_EQ(malformed(html), "");
  EXPECT_THAT(html, HasSubstr("<td>first: module</td><td>3 mm</td><td>yours</td>"));
  EXPECT_THAT(html, HasSubstr("<td>K<sub>v</sub>, ISO 6336-1 method B</td>"));
  EXPECT_THAT(html, HasSubstr(" rpm"));
  EXPECT_THAT(html, HasSubstr("<span class=\"raw\">push_max</span>"));
  // As that of table1-gear above, whose pair it is: in the main resonance it has no speed in it.
  EXPECT_THAT(html, HasSubstr("<td>2.619</td>"));
}

// The second pinion of 18 teeth turns with a gear of 41, so its mesh meets a natural frequency at a
// speed of the first one's that is higher by 41/18.
TEST(Report, OfTwoStagesCountsTheOrdersOfBothMeshes) {
  const std::string html =
      report_of(find_study("two-stage-gear", {"axes.0.count=5", "integrate.settle=2",
                                              "integrate.record=1", "integrate.stop=never"}));
  EXPECT_EQ(malformed(html), "");
  EXPECT_THAT(html, HasSubstr("order 1/2 of second"));
  EXPECT_THAT(html, HasSubstr("violet, dashed: those of second"));
  static const std::regex kRow(
      "<td>1388 Hz</td>.*?<td>(?:<b>)?(\\d+) rpm(?:</b>)?</td>"
      "(?:<td>(?:<b>)?\\d+ rpm(?:</b>)?</td>){3}"
      "<td>(?:<b>)?(\\d+) rpm");
  std::smatch speeds;
  ASSERT_TRUE(std::regex_search(html, speeds, kRow));
  EXPECT_NEAR(std::stod(speeds[2]) / std::stod(speeds[1]), 41.0 / 18.0, 1e-3);
  // A load of the second mesh is one number, and no list.
  EXPECT_THAT(html, ::testing::ContainsRegex("<td>mean load of the second mesh[^/]*/span>[^/]*/sub>"
                                             "[^/]*/sub>.</td><td>[0-9.]+</td>"));
}

// The band is around the curve without tolerances; only its own run has draws.
TEST(Report, OfAStudyWithTolerancesHasTheirBand) {
  std::vector<std::string> changes = small();
  for (const char* change : {"uncertain.samples=6", "uncertain.torque_N_m.distribution=\"normal\"",
                             "uncertain.torque_N_m.std=2"}) {
    changes.emplace_back(change);
  }
  const std::string html = report_of(find_study("table1-gear", changes));
  EXPECT_EQ(malformed(html), "");
  EXPECT_THAT(html, HasSubstr("<h2>Tolerances</h2>"));
  EXPECT_THAT(html, HasSubstr("over 6 draws of torque_N_m"));
}

std::string report_refusal(const std::string& axis, const std::string& path) {
  const Study study = read_study("[model]\nname = 'gear1'\n[[axes]]\nname = '" + axis +
                                     "'\nvalues = [0.6, 0.7]\n[observe]\nquantities = ['x_rms']\n",
                                 "test");
  try {
    ensure_report({{study, ""}}, path);
  } catch (const InputError& error) {
    return error.what();
  }
  return "it was taken";
}

TEST(Report, SaysWhatItNeeds) {
  EXPECT_THAT(report_refusal("Fm", "/tmp/report.html"), HasSubstr("name = \"omega\""));
  EXPECT_THAT(report_refusal("omega", "/tmp/report.txt"), HasSubstr(".html"));
  EXPECT_THAT(report_refusal("omega", "/nowhere/report.html"), HasSubstr("/nowhere"));
}

// What the answer says is what the maps have: the fixture's numbers are looked up in the page's own
// table of worst speeds, whose first column is the worst one.
TEST(Report, BeginsWithItsWorstSpeed) {
  std::vector<std::string> changes = small();
  changes.emplace_back("axes.omega.to=1.1");
  const std::string html = report_of(find_study("table1-gear", changes));
  static const std::regex kAnswer(
      "The worst speed is ([0-9]+) rpm[^:]*: the largest force between the teeth is ([0-9.]+) "
      "times "
      "the mean load, and the teeth lose contact: they are apart for ([0-9]+) % of the time");
  static const std::regex kNext(
      "the next critical speed, ([0-9]+) rpm \\(order ([1-3]) of ([0-9]+) "
      "Hz\\), is ([0-9.]+) % higher");
  std::smatch answer, next;
  ASSERT_TRUE(std::regex_search(html, answer, kAnswer));
  ASSERT_TRUE(std::regex_search(html, next, kNext));
  EXPECT_LT(html.find("class=\"answer\""), html.find("<h2>"));
  const double worst = std::stod(answer[1]), critical = std::stod(next[1]);
  // An order of the mesh frequency, teeth times the speed, is the natural frequency. Rounded to rpm
  // and Hz.
  EXPECT_NEAR(std::stod(next[2]) * 40.0 * critical / 60.0, std::stod(next[3]), 3.0);
  EXPECT_NEAR(100.0 * (critical / worst - 1.0), std::stod(next[4]), 0.5);
  const double factor = std::stod(answer[2]);
  const std::regex in_table("dynamic_load_factor</span></td><td>([0-9.]+)</td>");
  std::smatch first;
  ASSERT_TRUE(std::regex_search(html, first, in_table));
  EXPECT_NEAR(std::stod(first[1]), factor, 0.03 * factor);  // a run through the speeds may have 2 %
}

// The mesh with the larger error vibrates more, be it the first or the second.
TEST(Report, AnswersForTheWorseOfTwoMeshes) {
  const auto report = [](const std::string& first, const std::string& second) {
    return report_of(read_study(
        "[model]\nname = \"two_stages\"\n[parameters]\nzp_first = 10\nteeth_ratio_first = 1\n"
        "zp_second = 10\nteeth_ratio_second = 1\ne0_first = [" +
            first + "]\ne0_second = [" + second +
            "]\n[[axes]]\nname = \"omega\"\nfrom = 0.3\nto = 0.9\ncount = 3\n[integrate]\n"
            "settle = 10\nrecord = 4\n",
        "two.toml"));
  };
  const std::string of_first = report("0.5", "0.0"), of_second = report("0.0", "0.5");
  EXPECT_THAT(of_first, HasSubstr(": the largest force of the first mesh is "));
  EXPECT_THAT(of_first, HasSubstr("The largest force of the second mesh is at most "));
  EXPECT_THAT(of_second, HasSubstr(": the largest force of the second mesh is "));
  EXPECT_THAT(of_second, HasSubstr("The largest force of the first mesh is at most "));
  EXPECT_THAT(of_second, HasSubstr("Peaks of the largest"));
}

// A linear gear under its load keeps contact: no error, no friction, a stiffness that varies
// little.
TEST(Report, SaysThatTeethStayInContact) {
  std::vector<std::string> changes = small();
  changes.insert(changes.end(),
                 {"gear.transmission_error_um=0", "axes.omega.from=0.1", "axes.omega.to=0.3"});
  const std::string html = report_of(find_study("table1-gear", changes));
  EXPECT_THAT(html, HasSubstr("The teeth stay in contact at all 12 speeds."));
  EXPECT_THAT(html, Not(HasSubstr("alt=\"Share of time without contact")));
}

std::string new_pair(const std::string& more) {
  return "title = 'a pair'\n[model]\nname = 'gear5'\n[gear]\nteeth = [19, 61]\nmodule_mm = 2.5\n"
         "body = 'solid'\nface_width_mm = 25\nbearing_stiffness_N_per_mm = 2e5\n"
         "bearing_damping_N_s_per_mm = 2\nmesh_damping_ratio = 0.07\nhalf_backlash_mm = 0.06\n"
         "torque_N_m = 59\ntransmission_error_um = 5\n" +
         more +
         "[[axes]]\nname = 'omega'\nfrom = 0.3\nto = 1.2\ncount = 10\n"
         "[integrate]\nsettle = 30\nrecord = 10\nstop = 'never'\n[observe]\nquantities = "
         "['x1_rms']\n";
}

// A file may stand for a key that was a guess; a name that is no key is a slip of the pen.
TEST(Report, TakesEstimatesThatAreGone) {
  const Study study = read_study(new_pair("estimated = ['torque_N_m', 'mass_kg']\n"), "test");
  const auto is_guess = [&](const std::string& key) {
    const auto datum = std::ranges::find(study.gear_data, key, &GearDatum::key);
    return datum != study.gear_data.end() && datum->origin == DatumOrigin::estimated;
  };
  EXPECT_TRUE(is_guess("torque_N_m"));
  EXPECT_THROW(read_study(new_pair("estimated = ['torque_Nm']\n"), "test"), InputError);
}

TEST(Report, SaysWhoseEachNumberIs) {
  const std::string html = report_of(
      read_study(new_pair("estimated = ['torque_N_m']\npinion_speed_rpm = 12000\n"), "test"));
  EXPECT_EQ(malformed(html), "");
  EXPECT_THAT(html, HasSubstr("<td>module</td><td>2.5 mm</td><td>yours</td>"));
  EXPECT_THAT(html, HasSubstr("<td>torque</td><td>59 N m</td><td><b>estimated</b></td>"));
  EXPECT_THAT(html, HasSubstr("<b>estimated</b>: steel discs</td>"));
  EXPECT_THAT(html, HasSubstr("<b>estimated</b>: ISO 6336-1, method B</td>"));
  EXPECT_THAT(html, HasSubstr("<td>pressure angle</td><td>20 °</td><td>default</td>"));
  EXPECT_THAT(html, HasSubstr("mu</span></td><td>0.05</td><td>default</td>"));
  // Torque, damping ratio, mass, inertia and stiffness.
  EXPECT_THAT(html, HasSubstr("5 of the drawing's numbers are estimates"));
  EXPECT_THAT(html, HasSubstr("At the speed in use, 12000 rpm, the largest force"));
  EXPECT_THAT(html, HasSubstr("Chen et al. 2011, Eq. 20"));
  // Each equation has its paper before it.
  for (std::size_t at = 0; (at = html.find("Eq. ", at)) != std::string::npos; ++at) {
    EXPECT_EQ(html.substr(at - 6, 6), "2011, ") << html.substr(at - 60, 80);
  }
}

// The viewBox and the numbers at the axes of two pictures are the same where the studies differ.
TEST(Report, OfTwoStudiesHasThemSideBySide) {
  const std::string html =
      report_of({{read_study(new_pair(""), "test"), "sound"},
                 {read_study(new_pair("damage = [0.3, 0]\n"), "test"), "cracked <b>"}});
  EXPECT_EQ(malformed(html), "");
  EXPECT_THAT(html, HasSubstr("<h1>a pair: sound against cracked &lt;b&gt;</h1>"));
  EXPECT_THAT(html, HasSubstr("<td>damage</td><td>0</td><td>0.3, 0</td>"));
  EXPECT_THAT(html, Not(HasSubstr("<td>torque</td><td>59 N m</td><td>59 N m</td>")));
  const auto figures = [&](const std::string& caption) {
    std::size_t count = 0;
    for (std::size_t at = 0; (at = html.find("alt=\"" + caption, at)) != std::string::npos; ++at) {
      ++count;
    }
    return count;
  };
  for (const char* caption : {"Dynamic load factor", "Range of transmission error", "Order map"}) {
    EXPECT_EQ(figures(std::string("sound: ") + caption), 1U) << caption;
    EXPECT_EQ(figures(std::string("cracked &lt;b&gt;: ") + caption), 1U) << caption;
  }
  EXPECT_EQ(tics_of_figure(html, "sound: Dynamic load factor"),
            tics_of_figure(html, "cracked &lt;b&gt;: Dynamic load factor"));
}

TEST(Report, ComparesOnlyWhatHasTheSameUnits) {
  const Study plain = read_study(
      "[model]\nname = 'gear1'\n[[axes]]\nname = 'omega'\nvalues = [0.6, 0.7]\n", "test");
  EXPECT_THAT(
      [&] {
        ensure_report({{plain, "plain"}, {read_study(new_pair(""), "test"), "pair"}},
                      "/tmp/report.html");
      },
      ::testing::ThrowsMessage<InputError>(HasSubstr("'plain' and 'pair' cannot be compared")));
}

TEST(HtmlPage, TakesTextForText) {
  EXPECT_EQ(html_text("<script>\"a\" & 'b'\x01"), "&lt;script&gt;&quot;a&quot; &amp; &#39;b&#39; ");
  EXPECT_EQ(html_unit("k0 b_n"), "k<sub>0</sub> b<sub>n</sub>");
  HtmlPage page("</title><script>");
  page.table({html_text("a<b")}, {{html_text("c>d")}});
  EXPECT_EQ(malformed(page.text()), "");
  EXPECT_THAT(page.text(), Not(HasSubstr("<script>")));
}

}  // namespace
}  // namespace gearsweep
