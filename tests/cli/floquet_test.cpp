// gearsweep floquet as a user types it.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <nlohmann/json.hpp>
#include <numbers>
#include <regex>
#include <string>
#include <vector>

#include "support/process.hpp"

namespace gearsweep::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

const char* const kPendulum = R"([model]
name = "pendulum"
preset = "cascade"
[[axes]]
name = "damping"
from = 0.72
to = 0.75
count = 4
[integrate]
settle = 300
[observe]
quantities = ["x_rms"]
)";

// The pendulum doubles its period at Q = 1/damping = 1.34921264, damping 0.741173.
TEST(FloquetCommand, TellsOrbitMultipliersAndBifurcations) {
  const Folder folder;
  folder.write("pendulum.toml", kPendulum);
  const Outcome text =
      gearsweep(folder, "floquet pendulum.toml --at damping=0.745 --along damping=0.735:0.75");
  EXPECT_EQ(text.status, 0) << text.err;
  EXPECT_THAT(text.out, HasSubstr("pendulum at damping = 0.745\norbit of period 1 (stable)"));
  EXPECT_THAT(text.out, HasSubstr("nearest bifurcation: flip"));
  EXPECT_THAT(text.out, HasSubstr("damping = 0.741173"));
  EXPECT_EQ(folder.files(), std::set<std::string>{"pendulum.toml"});

  const Outcome json = gearsweep(
      folder, "floquet pendulum.toml --json --at damping=0.745 --along damping=0.735:0.75");
  EXPECT_THAT(json.out, HasSubstr("\"kind\": \"flip\""));
  EXPECT_THAT(json.out, HasSubstr("\"value\": 0.741173"));
}

// What leaves at the published doublings of damping 1/1.34921264 and 1/1.37012224.
TEST(FloquetCommand, SwitchesToWhatLeaves) {
  const Folder folder;
  folder.write("pendulum.toml", kPendulum);
  const std::string command = "floquet pendulum.toml --along damping=0.75:0.725 --steps 512";
  const Outcome text = gearsweep(folder, command + " --switch 2");
  EXPECT_EQ(text.status, 0) << text.err;
  EXPECT_THAT(text.out,
              AllOf(HasSubstr("\nbranch 1, of period 2, leaves the first at the flip at damping = "
                              "0.74117301"),
                    HasSubstr("\nbranch 2, of period 4, leaves branch 1 at the flip at damping = "
                              "0.72986188")));
  const auto json = nlohmann::json::parse(gearsweep(folder, command + " --switch 1 --json").out);
  ASSERT_EQ(json.at("leaving").size(), 1U);
  const nlohmann::json& leaving = json.at("leaving")[0];
  EXPECT_EQ(leaving.at("leaves"), 0);
  EXPECT_EQ(leaving.at("period"), 2);
  EXPECT_NEAR(leaving.at("origin").at("value").get<double>(), 1.0 / 1.34921264, 2e-8);
  EXPECT_NEAR(leaving.at("bifurcations")[0].at("value").get<double>(), 1.0 / 1.37012224, 2e-8);
  EXPECT_GT(leaving.at("branches")[0].at("orbits").size(), 5U);
  const Outcome alone = gearsweep(folder, "floquet pendulum.toml --at damping=0.745 --switch 1");
  EXPECT_EQ(alone.status, 2);
  EXPECT_THAT(alone.err, HasSubstr("--switch requires --along"));
}

// What leaves a cycle has twice its returns. The value is that of shooting by SciPy's DOP853.
TEST(FloquetCommand, SwitchesToDoubledCycles) {
  const Folder folder;
  folder.write("rossler.toml", "[model]\nname = 'rossler'\n[[axes]]\nname = 'c'\nvalues = [2.5]\n");
  const Outcome text = gearsweep(folder, "floquet rossler.toml --along c=2.5:3.2 --switch 1");
  EXPECT_EQ(text.status, 0) << text.err;
  EXPECT_THAT(text.out, HasSubstr("\nbranch 1, with 2 returns to where x is largest, leaves the "
                                  "first at the flip at c = 2.832445"));
}

// The start of --along stands in for a value in --at; a state of --at chooses the motion, here the
// well that it stays in.
TEST(FloquetCommand, StartsWhereItIsTold) {
  const Folder folder;
  folder.write("pendulum.toml", kPendulum);
  EXPECT_THAT(gearsweep(folder, "floquet pendulum.toml --along damping=0.745:0.75").out,
              HasSubstr("pendulum at damping = 0.745"));
  folder.write("wells.toml",
               "[model]\nname = 'duffing'\npreset = 'two_well'\n[parameters]\ndamping = 0.3\n"
               "omega = 1.2\n[[axes]]\nname = 'amplitude'\nvalues = [0.2]\n"
               "[observe]\nquantities = ['x_rms']\n");
  EXPECT_THAT(gearsweep(folder, "floquet wells.toml --at x=1.0").out, HasSubstr("\n  x    0."));
  EXPECT_THAT(gearsweep(folder, "floquet wells.toml --at x=-1.0").out, HasSubstr("\n  x    -"));
}

// A printed number beside the true one: the digits after the point, of which the last may be one
// off.
void expect_digits(const std::string& printed, double truth, std::size_t digits) {
  const std::size_t point = printed.find('.');
  const std::size_t after = point == std::string::npos ? 0 : printed.size() - point - 1;
  EXPECT_GE(after, digits) << printed;
  EXPECT_LE(std::fabs(std::stod(printed) - truth), std::pow(10.0, -static_cast<double>(after)))
      << printed << " for " << truth;
}

// The groups of the first match of an expression in a text.
std::vector<std::string> found(const std::string& text, const std::string& expression) {
  std::smatch match;
  EXPECT_TRUE(std::regex_search(text, match, std::regex(expression))) << expression << '\n' << text;
  return {match.begin(), match.end()};
}

// The real and the imaginary part of the first multiplier.
std::vector<std::string> first_multiplier(const std::string& text) {
  return found(text, "hold\\)\n +[0-9.]+ +(-?[0-9.]+) [-+]([0-9.]+)i");
}

// The answers of an independent integrator of order 8 that locates the impacts, to as many digits
// as it was asked for.
TEST(FloquetCommand, DigitsOfAnOrbitWithImpactsHold) {
  const Folder folder;
  const std::string text =
      gearsweep(folder, "floquet coarse-map --at omega=0.55,e0=0.6 --period 1").out;
  const std::vector<std::string> multiplier = first_multiplier(text);
  ASSERT_EQ(multiplier.size(), 3U);
  expect_digits(multiplier[1].substr(0, 11), -0.10191766, 8);
  expect_digits(multiplier[2].substr(0, 10), 1.07545673, 8);

  const std::string along =
      gearsweep(folder, "floquet coarse-map --at omega=1,e0=0.6 --along omega=1:1.6 --steps 1024")
          .out;
  const std::vector<std::string> bifurcations =
      found(along,
            "Neimark-Sacker +omega = ([0-9.]+)\n +flip +omega = ([0-9.]+)\n +Neimark-Sacker "
            "+omega = ([0-9.]+)\n");
  ASSERT_EQ(bifurcations.size(), 4U);
  expect_digits(bifurcations[1].substr(0, 10), 1.03335299, 8);
  expect_digits(bifurcations[2].substr(0, 10), 1.54086315, 8);
  expect_digits(bifurcations[3].substr(0, 10), 1.59767219, 8);
}

// gear1 with constant stiffness 1 under the load 0.1, from the start of its motion without impact:
// a swing about the static deflection of 0.1.
struct LinearGear {
  double z = 0.05, w = 0.8, Fte = 0.0;
  double period() const { return 2.0 * std::numbers::pi / w; }
  std::complex<double> swing() const {
    return Fte * w * w / std::complex<double>(1.0 - w * w, 2.0 * z * w);
  }
  // One of the two, the other its conjugate.
  std::complex<double> multiplier() const {
    return std::exp(std::complex<double>(-z, std::sqrt(1.0 - z * z)) * period());
  }
  std::string study() const {
    return fmt::format(
        "[model]\nname = 'gear1'\n[parameters]\nomega = {:.17g}\nz = {:.17g}\nk = 0.0\n"
        "k_2 = 0.0\nk_3 = 0.0\nFm = 0.1\nFte_2 = 0.0\nFte_3 = 0.0\n[[axes]]\nname = 'Fte'\n"
        "values = [{:.17g}]\n[initial]\npolicy = 'fixed'\nstate = {{x = {:.17g}, v = {:.17g}}}\n"
        "[observe]\nquantities = ['x_rms']\n",
        w, z, Fte, 1.1 + swing().real(), -w * swing().imag());
  }
};

// However coarse the steps, and where the motion grazes its limit, where the swing is just the
// static deflection: what is printed holds.
TEST(FloquetCommand, DigitsHoldAtAnySteps) {
  const Folder folder;
  LinearGear gear;
  gear.Fte = 1.0;
  const double grazing = 0.1 / std::abs(gear.swing());
  for (const double share : {0.3, 0.9, 1.0 - 1e-12}) {
    gear.Fte = share * grazing;
    folder.write("linear.toml", gear.study());
    for (const std::size_t steps : {128U, 256U, 2048U}) {
      const std::string text =
          gearsweep(folder, fmt::format("floquet linear.toml --steps {}", steps)).out;
      const std::vector<std::string> multiplier = first_multiplier(text);
      ASSERT_EQ(multiplier.size(), 3U);
      const bool grazes = share > 0.99;
      const std::size_t digits = grazes ? 1 : steps == 2048 ? 9 : 4;
      expect_digits(multiplier[1], gear.multiplier().real(), digits);
      expect_digits(multiplier[2], gear.multiplier().imag(), digits);
      EXPECT_EQ(text.find("the motion grazes a limit") != std::string::npos, grazes) << text;
      // The state is known to 1e-11 at best, and the multipliers to the root of that.
      EXPECT_TRUE(!grazes || multiplier[1].size() <= std::string("0.00000").size()) << text;
    }
  }
  EXPECT_THAT(gearsweep(folder, "floquet linear.toml --steps 16").out,
              HasSubstr("nearest bifurcation: unknown, as no multiplier is"));
}

struct Refusal {
  std::string arguments, message;
};

void PrintTo(const Refusal& refusal, std::ostream* out) { *out << refusal.arguments; }

class FloquetRefusal : public ::testing::TestWithParam<Refusal> {};

TEST_P(FloquetRefusal, SaysWhatIsWrong) {
  const Folder folder;
  folder.write("pendulum.toml", kPendulum);
  const Outcome outcome = gearsweep(folder, "floquet pendulum.toml " + GetParam().arguments);
  EXPECT_EQ(outcome.status, 2) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr(GetParam().message));
  EXPECT_EQ(outcome.out, "");
}

INSTANTIATE_TEST_SUITE_P(
    Cases, FloquetRefusal,
    ::testing::Values(
        Refusal{"", "--at gives no value for the study's axis 'damping': add damping=0.72"},
        Refusal{"--at dampng=0.7",
                "unknown parameter 'dampng' of model 'pendulum'; did you mean "
                "'damping'?"},
        Refusal{"--at damping=0.7x", "--at: '0.7x' is not a number"},
        Refusal{"--at damping", "--at: 'damping' is not of the form omega=0.7"},
        Refusal{"--at damping=1000", "--at: damping = 1000 is out of range; -10 .. 100"},
        Refusal{"--along dampin=0.7:0.8", "--along: unknown parameter 'dampin'"},
        Refusal{"--along damping=0.7", "is not of the form omega=0.6:0.8"},
        Refusal{"--along damping=0.7:0.7", "--along: the range is empty"},
        Refusal{"--at damping=0.5 --along damping=0.7:0.8", "is not in the range of --along"}));

TEST(FloquetCommand, ChaosIsNoOrbitAndSaysWhatToTry) {
  const Folder folder;
  folder.write("pendulum.toml", kPendulum);
  const Outcome outcome =
      gearsweep(folder, "floquet pendulum.toml --at damping=0.05,drive=0.6,omega=0.7");
  EXPECT_EQ(outcome.status, 1);
  EXPECT_THAT(outcome.err, HasSubstr("--period"));
}

// x'' = x - x^3 - 0.3 x' + g cos(1.2 t) with x in another unit of length and t in another of time.
// Periods are those of the plain equations, 1, 2 and 5 at g = 0.2, 0.28 and 0.37; so are
// multipliers and the doubling at 0.26558178, which DOP853 finds too.
TEST(FloquetCommand, DoesNotDependOnUnits) {
  const Folder folder;
  for (const auto& [length, time] :
       std::vector<std::pair<double, double>>{{1e-9, 1e-6}, {1.0, 1.0}, {1e6, 1e5}}) {
    folder.write("wells.model",
                 "[model]\nname = 'wells'\n[states]\nx = {}\nv = {}\n[parameters]\ng = 0.2\n"
                 "[equations]\nx = 'v'\n" +
                     fmt::format("v = 'x/{1}^2 - x^3/({0}^2*{1}^2) - 0.3*v/{1} + "
                                 "{0}*g/{1}^2*cos(phase)'\n[forcing]\nperiod = '2*pi/1.2*{1}'\n",
                                 length, time));
    folder.write("wells.toml",
                 fmt::format("[model]\nfile = 'wells.model'\n[[axes]]\nname = 'g'\nvalues = [0.2]\n"
                             "[initial]\nstate = {{x = {}, v = {}}}\n[integrate]\nsettle = 400\n",
                             0.5 * length, 0.1 * length / time));
    const auto floquet = [&](const std::string& words) {
      const Outcome outcome = gearsweep(folder, "floquet wells.toml " + words);
      EXPECT_EQ(outcome.status, 0) << outcome.err;
      return outcome.out;
    };
    const std::string along = floquet("--along g=0.2:0.28");
    EXPECT_THAT(along, HasSubstr("0.455938128    0.039064949 +0.454261495i"));
    EXPECT_THAT(along, HasSubstr("flip               g = 0.26558178"));
    EXPECT_THAT(floquet("--at g=0.28"), HasSubstr("orbit of period 2 (stable)"));
    EXPECT_THAT(floquet("--at g=0.37"), HasSubstr("orbit of period 5 (stable)"));
  }
}

// The maximum of x, where a cycle is found, is where the friction jumps. The clock's cycle ends
// where its friction takes what a push gives, at 1/sqrt(96).
TEST(FloquetCommand, FollowsCyclesWhoseMaximumIsAtAJump) {
  const Folder folder;
  folder.write("clock.toml",
               "[model]\nname = 'clock'\n[[axes]]\nname = 'friction'\nvalues = [0.1]\n"
               "[observe]\nquantities = ['x_rms']\n");
  const Outcome outcome = gearsweep(folder, "floquet clock.toml --along friction=0.1:0.11");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("no smooth way on from friction = 0.10206207"));
}

TEST(FloquetCommand, TellsCyclesAndEquilibriaOfModelsThatNothingDrives) {
  const Folder folder;
  folder.write("rossler.toml",
               "[model]\nname = 'rossler'\n[[axes]]\nname = 'c'\nvalues = [2.5]\n"
               "[observe]\nquantities = ['x_rms']\n");
  folder.write("lorenz.toml",
               "[model]\nname = 'lorenz'\n[[axes]]\nname = 'rho'\nvalues = [22.0]\n"
               "[observe]\nquantities = ['x_rms']\n");
  const auto floquet = [&](const std::string& arguments) {
    return gearsweep(folder, "floquet " + arguments).out;
  };
  const std::string cycle = floquet("rossler.toml --along c=2.5:3");
  EXPECT_THAT(cycle,
              HasSubstr("cycle with 1 return to where x is largest (stable), T = 5.748991183\n"));
  EXPECT_THAT(cycle, HasSubstr("and the one along the cycle, which is 1: off by "));
  EXPECT_THAT(cycle, HasSubstr("flip               c = 2.83244503\n"));
  // It settles on one of the two rests.
  const std::string rest = floquet("lorenz.toml --at rho=20 --along rho=20:28");
  EXPECT_THAT(rest, HasSubstr("equilibrium (stable)\n"));
  EXPECT_THAT(rest, HasSubstr("Hopf               rho = 24.73684211\n"));
  const std::string origin = floquet("lorenz.toml --at x=0.1,y=0.1,z=0.1 --equilibrium");
  EXPECT_THAT(origin,
              HasSubstr("equilibrium (unstable, 1 of 3 eigenvalues with a positive real part)"));
  const nlohmann::json json = nlohmann::json::parse(floquet("rossler.toml --json"));
  EXPECT_EQ(json["kind"], "cycle");
  EXPECT_NEAR(json["cycle_time"].get<double>(), 5.748991183278, 1e-9);
  EXPECT_LT(json["cycle_time_error"].get<double>(), 1e-8);
  const Outcome chaos = gearsweep(folder, "floquet lorenz.toml --at rho=28");
  EXPECT_EQ(chaos.status, 1);
  EXPECT_THAT(chaos.err, HasSubstr("does not repeat itself within 64 returns"));
}

}  // namespace
}  // namespace gearsweep::testing
