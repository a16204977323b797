// gearsweep floquet as a user types it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "support/process.hpp"

namespace gearsweep::testing {
namespace {

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

TEST(FloquetCommand, AutonomousModelsAreRefused) {
  const Folder folder;
  folder.write("lorenz.toml",
               "[model]\nname = 'lorenz'\n[[axes]]\nname = 'rho'\nvalues = [28.0]\n"
               "[observe]\nquantities = ['x_rms']\n");
  const Outcome outcome = gearsweep(folder, "floquet lorenz.toml");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("autonomous"));
}

}  // namespace
}  // namespace gearsweep::testing
