// Parameters that expressions of others give: the maps of a model in which they are written out.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "support/bits.hpp"
#include "support/derived_model.hpp"
#include "support/run.hpp"

namespace gearsweep::testing {
namespace {

using ::testing::Contains;
using ::testing::Not;

const std::string kMaps =
    "[[axes]]\nname = 'wn'\nvalues = [0.8, 1.1, 2.0]\n"
    "[[axes]]\nname = 'zeta'\nvalues = [0.05, 0.2]\n"
    "[integrate]\nmax_step = 0.05\nsettle = 20\nrecord = 10\nstop = 'never'\n"
    "[observe]\nquantities = ['x_rms', 'v_max', 'period', 'lyapunov_max']\n";
const std::string kUncertain =
    "[uncertain]\nsamples = 4\nwn = {distribution = 'uniform', from = 0.9, to = 1.1, relative = "
    "true}\n";

// omega and e_2 as constants of their expressions.
std::string written_out() {
  std::string model = with_instead(
      derived_model(),
      "omega = { value = \"0.5*wn\", min = 0.01, max = 10, unit = \"1/s\", meaning = \"frequency\" "
      "}\n",
      "");
  model = with_instead(model, "e = [0.3, \"e[1]/2\", 0.1]\n", "e = 0.3\ne_3 = 0.1\n");
  return with_instead(model, "g = 9.75\n", "g = 9.75\nomega = \"0.5*wn\"\ne_2 = \"e/2\"\n");
}

void expect_same(const SweepResult& a, const SweepResult& b) {
  EXPECT_EQ(a.status, b.status);
  ASSERT_EQ(a.values.size(), b.values.size());
  for (std::size_t i = 0; i < a.values.size(); ++i) {
    EXPECT_EQ(different_bits(a.values[i], b.values[i]), 0U) << a.study.selection.quantities[i].name;
    EXPECT_THAT(a.values[i], Not(Contains(::testing::IsNan()))) << i;
  }
}

TEST(DerivedParameters, AreTheirExpressionsWrittenOut) {
  for (const char* engine : {"opencl", "reference"}) {
    const std::vector<std::string> chosen = {std::string("integrate.engine=") + engine};
    expect_same(run(study_of_text(derived_model(), kMaps), chosen),
                run(study_of_text(written_out(), kMaps), chosen));
  }
  const SweepResult drawn = run(study_of_text(derived_model(), kMaps + kUncertain));
  expect_same(drawn, run(study_of_text(written_out(), kMaps + kUncertain)));
  EXPECT_GT(drawn.values.size(), 4U);
}

TEST(DerivedParameters, OfStudiesAreThoseOfTheModel) {
  const std::string numbers =
      with_instead(with_instead(derived_model(), "\"0.5*wn\"", "7.0"), "\"e[1]/2\"", "8.0");
  expect_same(run(study_of_text(derived_model(), kMaps)),
              run(study_of_text(numbers, "[parameters]\nomega = '0.5*wn'\ne_2 = 'e/2'\n" + kMaps)));
}

// The chain goes on from point to point, each with its own period.
TEST(DerivedParameters, GoAlongAChain) {
  const std::string chain = kMaps + "[initial]\npolicy = 'forward'\nalong = 'wn'\n";
  expect_same(run(study_of_text(derived_model(), chain)), run(study_of_text(written_out(), chain)));
}

// The same numbers, given point by point: the device multiplies once more, so that the last digits
// differ, and a damped linear motion does not amplify that.
TEST(DerivedParameters, AreTheNumbersThatTheFileTells) {
  const SweepResult derived = run(study_of_text(derived_model(), kMaps));
  std::string points = "[points]\nnames = ['wn', 'zeta', 'omega']\nnumbers = '''\n";
  for (const char* zeta : {"0.05", "0.2"}) {
    for (const char* wn : {"0.8 ", "1.1 ", "2.0 "}) {
      const std::string omega = wn == std::string("0.8 ") ? "0.4" : wn[0] == '1' ? "0.55" : "1.0";
      points += wn + std::string(zeta) + " " + omega + "\n";
    }
  }
  const SweepResult listed = run(
      study_of_text(derived_model(), points + "'''\n" + kMaps.substr(kMaps.find("[integrate]"))));
  ASSERT_EQ(listed.status.size(), derived.status.size());
  for (std::size_t map : {0U, 1U}) {
    for (std::size_t i = 0; i < derived.status.size(); ++i) {
      EXPECT_NEAR(derived.values[map][i] / listed.values[map][i], 1.0, 1e-11) << map << " " << i;
    }
  }
}

// The contact ratio moves the phases where the stiffness jumps: each point has its own phase grid,
// whether the ratio is given or follows. The last digits differ as above.
TEST(DerivedParameters, MoveBreakPhases) {
  const std::string model = "[model]\npreset = 'coarse'\nstiffness = 'rectangular'\n";
  const std::string rest =
      "[integrate]\nmax_step = 0.05\nsettle = 20\nrecord = 5\nstop = 'never'\n"
      "[observe]\nquantities = ['x1_rms']\n";
  const std::string axis = "[[axes]]\nname = 'mu'\nvalues = [0.0, 0.0625]\n";
  const std::string points =
      "[points]\nnames = ['mu', 'eps']\nnumbers = '''\n0 1.5\n0.0625 1.75\n'''\n";
  const SweepResult derived = run(model + "[parameters]\neps = '1.5 + 4*mu'\n" + axis + rest);
  const SweepResult listed = run(model + points + rest);
  ASSERT_EQ(derived.status, std::vector<std::uint8_t>({0, 0}));
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(derived.values[0][i] / listed.values[0][i], 1.0, 1e-9);
  }
  EXPECT_GT(std::abs(derived.values[0][1] / derived.values[0][0] - 1.0), 1e-3);
}

// A constant that a study sweeps: where it has its number, the maps are those of the constant.
TEST(Constants, AreSweptAsParametersAre) {
  const std::string rest = kMaps.substr(kMaps.find("[[axes]]\nname = 'zeta'"));
  const SweepResult swept =
      run(study_of_text(derived_model(), "[[axes]]\nname = 'g'\nvalues = [1.0, 9.75]\n" + rest));
  const SweepResult fixed =
      run(study_of_text(derived_model(), "[[axes]]\nname = 'wn'\nvalues = [2.0]\n" + rest));
  for (std::size_t map : {0U, 1U}) {
    for (std::size_t zeta : {0U, 1U}) {
      const double other = swept.values[map][2 * zeta], same = swept.values[map][2 * zeta + 1];
      EXPECT_NEAR(same / fixed.values[map][zeta], 1.0, 1e-11);
      if (map == 0) {
        EXPECT_GT(std::abs(other - same), 0.1);
      }
    }
  }
}

}  // namespace
}  // namespace gearsweep::testing
