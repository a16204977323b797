// A stopped sweep goes on from its journal and ends in the same bits.
#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>
#include <string>

#include "support/bits.hpp"
#include "support/run.hpp"

namespace gearsweep::testing {
namespace {

// However slowly progress is heard of, a run that is to stop is not at its end: each of the engines
// of a device, of which fewer lanes make more, has begun one tile of 4 points at most whose end
// nobody has heard of. So when 24 points are told of, no more than 36 of the 60 are in the journal.
constexpr std::size_t kMaxEngines = 3;
constexpr std::size_t kMaxUnheard = 4 * kMaxEngines;

class Resume : public ::testing::Test {
 protected:
  Resume()
      : journal_(::testing::TempDir() + "resume_" +
                 ::testing::UnitTest::GetInstance()->current_test_info()->name() + ".journal") {
    std::filesystem::remove(journal_);
  }
  ~Resume() override { std::filesystem::remove(journal_); }

  // Runs until at least `points` are done; nothing, unless that is all of them.
  std::optional<SweepResult> run_until(const Study& study, std::size_t points) {
    std::atomic<bool> stop = false;
    SweepOptions options;
    options.journal_path = journal_;
    options.stop = &stop;
    options.on_progress = [&](const SweepProgress& progress) {
      resumed_ = progress.points_resumed;
      if (progress.points_done >= points) stop = true;
    };
    options.deliver = [&](const SweepResult&) {
      journal_at_delivery_ = std::filesystem::exists(journal_);
    };
    return run_sweep(study, options);
  }

  void expect_same_bits(const SweepResult& result, const SweepResult& expected) {
    EXPECT_EQ(result.status, expected.status);
    ASSERT_EQ(result.values.size(), expected.values.size());
    for (std::size_t i = 0; i < result.values.size(); ++i) {
      EXPECT_EQ(different_bits(result.values[i], expected.values[i]), 0U);
    }
    EXPECT_EQ(different_bits(result.samples, expected.samples), 0U);
  }

  // Stops twice, goes on twice.
  void expect_resumes(const std::string& toml) {
    const Study study = read_study(toml, "test.toml");
    const SweepResult expected = run(toml);
    EXPECT_FALSE(run_until(study, 8));
    EXPECT_EQ(resumed_, 0U);
    EXPECT_TRUE(std::filesystem::exists(journal_));
    EXPECT_FALSE(run_until(study, 24));
    EXPECT_GE(resumed_, 8U);
    EXPECT_LE(resumed_, 8U + kMaxUnheard);
    const std::optional<SweepResult> result = run_until(study, 10'000);
    ASSERT_TRUE(result);
    EXPECT_GE(resumed_, 24U);
    EXPECT_LE(resumed_, 24U + kMaxUnheard);
    EXPECT_TRUE(journal_at_delivery_);
    EXPECT_FALSE(std::filesystem::exists(journal_));
    expect_same_bits(*result, expected);
  }

  std::string journal_;
  std::size_t resumed_ = 0;
  bool journal_at_delivery_ = false;
};

// Chaotic points and, in the corner of the two larger masses, diverged ones: NaN survives too.
const std::string kInParts =
    "tile = 4\nsettle = 30\nrecord = 8\n[observe]\nquantities = ['x1_rms', 'dmf_max', "
    "'contact_class', 'poincare']\npoincare = ['x1', 'v1']\n";
const std::string kStudy =
    "[model]\npreset = 'coarse'\nformulation = 'printed'\n[[axes]]\nname = 'omega'\nfrom = 0.4\n"
    "to = 1.6\ncount = 12\n[[axes]]\nname = 'm1'\nvalues = [0.02, 0.03, 0.04, 0.35, 0.9]\n";

TEST_F(Resume, GivesTheSameBits) { expect_resumes(kStudy + "[integrate]\n" + kInParts); }

TEST_F(Resume, GivesTheSameBitsInTheReferenceEngine) {
  expect_resumes(kStudy + "[integrate]\nengine = 'reference'\n" + kInParts);
}

// The journal keeps the final states that the next stage of a chain starts from.
TEST_F(Resume, GoesOnInTheMiddleOfAChain) {
  expect_resumes(kStudy + "[initial]\npolicy = 'forward'\n[integrate]\n" + kInParts);
}

// The draws of a point may lie in tiles of both runs. They are of a parameter that the kernels take
// from a point's numbers in any case, and so the kernels are those of the tests above.
TEST_F(Resume, GoesOnAmongTheDrawsOfUncertainParameters) {
  expect_resumes(kStudy +
                 "[uncertain]\nsamples = 9\nF1 = {distribution = 'normal', std = 0.001}\n"
                 "[integrate]\n" +
                 kInParts);
}

// The nominal points of an earlier run are what draws of the next one start from.
TEST_F(Resume, GoesOnAmongDrawsThatStartFromTheNominalMotion) {
  expect_resumes(kStudy +
                 "[uncertain]\nsamples = 9\nstart = 'nominal'\nF1 = {distribution = 'normal', std "
                 "= 0.001}\n[integrate]\n" +
                 kInParts);
}

}  // namespace
}  // namespace gearsweep::testing
