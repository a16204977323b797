// How the work is cut up never shows in the result: lanes, tiles, groups and rounds give the same
// bits. Contraction is on, as it is by default.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "support/bits.hpp"
#include "support/run.hpp"

namespace gearsweep::testing {
namespace {

// The whole default result, or the whole result with overrides, must agree; `overrides` hold for
// both.
void expect_same(const SweepResult& expected, const std::string& toml,
                 std::vector<std::string> overrides) {
  std::string label;
  for (const std::string& override_ : overrides) label += override_ + " ";
  SCOPED_TRACE(label);
  const SweepResult result = run(toml, overrides);
  EXPECT_EQ(result.status, expected.status);
  ASSERT_EQ(result.values.size(), expected.values.size());
  for (std::size_t i = 0; i < result.values.size(); ++i) {
    EXPECT_EQ(different_bits(result.values[i], expected.values[i]), 0U)
        << result.study.selection.quantities[i].name;
  }
  EXPECT_EQ(different_bits(result.samples, expected.samples), 0U) << "samples";
}

const std::string kObserve =
    "[observe]\nquantities = ['x1_min', 'x1_max', 'x1_rms', 'x5_std', 'dmf_max', 'backlash_mean', "
    "'backlash_min', 'backlash_max', 'contact_drive', 'contact_losses', 'contact_class', "
    "'poincare']\npoincare = ['x1', 'v4']\n";

// No impact to chaos, several phase grids whose sizes are no multiple of any number of lanes. The
// search for orbits has kernels of its own, which take as long to build: it is cut up with constant
// backlash in fp64, where an axis shapes the phase, and in OrbitSearch.IsTheSameForAnyCut.
std::string chaotic(const std::string& backlash, const std::string& stop = "never") {
  return "[model]\npreset = 'coarse'\nbacklash = '" + backlash +
         "'\n[[axes]]\nname = 'omega'\nfrom = 0.3\nto = 1.9\ncount = 13\n"
         "[[axes]]\nname = 'b'\nfrom = 0.1\nto = 1.3\ncount = 7\n"
         "[integrate]\nsettle = 21\nrecord = 11\nmax_step = 0.1\nstop = '" +
         stop + "'\n" + kObserve;
}

void expect_any_cut(const std::string& toml, const std::string& precision,
                    const std::vector<std::string>& lanes) {
  const std::string precise = "integrate.precision=" + precision;
  const SweepResult expected = run(toml, {precise, "integrate.lanes=1"});
  const std::vector<double>& classes = map_of(expected, "contact_class");
  ASSERT_GE(std::set<double>(classes.begin(), classes.end()).size(), 3U);  // all regimes occur
  for (const std::string& count : lanes) {
    expect_same(expected, toml, {precise, "integrate.lanes=" + count});
  }
  for (const char* cut : {"integrate.tile=10", "integrate.tile=1000", "integrate.local_size=1",
                          "integrate.local_size=16", "integrate.round=1", "integrate.round=7",
                          "integrate.round=1000"}) {
    expect_same(expected, toml, {precise, cut});
  }
}

TEST(SameBits, Fp64ConstantBacklash) {
  expect_any_cut(chaotic("constant", "orbit"), "fp64", {"2", "4", "8"});
}
TEST(SameBits, Fp64DynamicBacklash) { expect_any_cut(chaotic("dynamic"), "fp64", {"4", "8"}); }
TEST(SameBits, Fp32ConstantBacklash) { expect_any_cut(chaotic("constant"), "fp32", {"8", "16"}); }
TEST(SameBits, Fp32DynamicBacklash) { expect_any_cut(chaotic("dynamic"), "fp32", {"8", "16"}); }

// With so small a centre distance the shafts move out of the range of the dynamic backlash's series
// and back, and so the lanes of a work-item need different forms of it. The range ends where the
// backlash has grown by about A tan(alpha)/256.
TEST(SameBits, LanesOnBothSidesOfABranch) {
  const double limit = 60.0 * std::tan(20.0 * std::numbers::pi / 180.0) / 256.0;
  const std::string toml = chaotic("dynamic") + "[parameters]\nA = 60\n";
  for (const auto& [precision, count] :
       {std::pair{"fp64", "4"}, std::pair{"fp64", "8"}, std::pair{"fp32", "16"}}) {
    const std::string precise = std::string("integrate.precision=") + precision;
    const SweepResult expected = run(toml, {precise, "integrate.lanes=1"});
    const std::vector<double>& min = map_of(expected, "backlash_min");
    const std::vector<double>& max = map_of(expected, "backlash_max");
    std::size_t across = 0;
    for (std::size_t i = 0; i < min.size(); ++i) {
      const double b = 0.1 + 0.2 * static_cast<double>(i / 13);  // 13 values of omega
      if (min[i] - b < 0.9 * limit && max[i] - b > 1.1 * limit) ++across;
    }
    EXPECT_GT(across, min.size() / 2);
    expect_same(expected, toml, {precise, std::string("integrate.lanes=") + count});
  }
}

// Each value of the contact ratio has a phase grid of its own.
TEST(SameBits, AxisThatShapesThePhase) {
  const std::string toml =
      "[model]\npreset = 'coarse'\nbacklash = 'dynamic'\n[[axes]]\nname = 'omega'\n"
      "values = [0.5, 0.65, 1.15, 1.5, 1.7]\n[[axes]]\nname = 'eps'\n"
      "values = [1.2, 1.5, 1.718]\n[integrate]\nsettle = 20\nrecord = 10\n" +
      kObserve;
  const SweepResult expected = run(toml);
  for (const char* cut :
       {"integrate.lanes=1", "integrate.tile=4", "integrate.round=3", "integrate.local_size=2"}) {
    expect_same(expected, toml, {cut});
  }
}

TEST(SameBits, ChainsForwardAndBackward) {
  for (const char* policy : {"forward", "backward"}) {
    const std::string toml =
        chaotic("constant") + "[initial]\npolicy = '" + policy + "'\nalong = 'omega'\n";
    const SweepResult expected = run(toml, {"integrate.lanes=1"});
    for (const char* cut :
         {"integrate.lanes=4", "integrate.lanes=8", "integrate.tile=3", "integrate.round=5"}) {
      expect_same(expected, toml, {cut});
    }
  }
}

}  // namespace
}  // namespace gearsweep::testing
