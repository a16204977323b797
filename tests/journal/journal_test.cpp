// What was stored in a journal comes back to the bit, and only to the sweep that stored it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <iterator>
#include <limits>

#include "journal/example_journal.hpp"

namespace gearsweep::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;

TEST_F(JournalTest, ANewJournalIsEmpty) {
  const Journal journal(path_, kSweepA);
  EXPECT_EQ(journal.finished_tiles(), 0U);
  EXPECT_FALSE(journal.find(0).has_value());
}

// SQLite takes "file:..." for an address, of which '?' and '#' end the path.
TEST_F(JournalTest, ANameLikeAnAddressIsAName) {
  const fs::path before = fs::current_path();
  fs::current_path(folder_);
  { const Journal journal("file:map.nc?mode=memory", kSweepA); }
  fs::current_path(before);
  EXPECT_TRUE(fs::exists(folder_ / "file:map.nc?mode=memory"));
}

TEST_F(JournalTest, ATileComesBackToTheBit) {
  TileResult tile = example_tile(7);
  double signalling = 0.0;
  const std::uint64_t nan_with_payload = 0xfff4000000000123U;
  std::memcpy(&signalling, &nan_with_payload, sizeof signalling);
  tile.outputs[0] = std::numeric_limits<double>::quiet_NaN();
  std::memcpy(&tile.outputs[1], &signalling, sizeof signalling);
  tile.outputs[2] = -0.0;
  tile.outputs[3] = std::numeric_limits<double>::denorm_min();
  tile.outputs[4] = -std::numeric_limits<double>::infinity();

  Journal journal(path_, kSweepA);
  journal.store(7, tile);
  EXPECT_EQ(journal.finished_tiles(), 1U);
  ASSERT_TRUE(journal.find(7).has_value());
  EXPECT_TRUE(same_bits(*journal.find(7), tile));
  EXPECT_FALSE(journal.find(6).has_value());
}

TEST_F(JournalTest, EmptyVectorsAreKept) {
  Journal journal(path_, kSweepA);
  journal.store(0, TileResult{});
  ASSERT_TRUE(journal.find(0).has_value());
  EXPECT_TRUE(same_bits(*journal.find(0), TileResult{}));
}

TEST_F(JournalTest, TheLastResultOfATileStands) {
  Journal journal(path_, kSweepA);
  journal.store(3, example_tile(1, 200));
  journal.store(3, example_tile(2, 50));
  EXPECT_EQ(journal.finished_tiles(), 1U);
  EXPECT_TRUE(same_bits(*journal.find(3), example_tile(2, 50)));
}

TEST_F(JournalTest, AVectorLongerThanOnePieceComesBack) {
  TileResult tile;
  // 80 MiB: more than the 64 MiB of one piece.
  tile.samples.resize(std::size_t{10} << 20);
  for (std::size_t i = 0; i < tile.samples.size(); ++i) tile.samples[i] = static_cast<double>(i);
  Journal journal(path_, kSweepA);
  journal.store(0, tile);
  EXPECT_TRUE(same_bits(*journal.find(0), tile));
}

TEST_F(JournalTest, ReopeningGoesOn) {
  {
    Journal journal(path_, kSweepA);
    journal.store(0, example_tile(0));
    journal.store(2, example_tile(2));
  }
  Journal journal(path_, kSweepA);
  EXPECT_EQ(journal.finished_tiles(), 2U);
  journal.store(1, example_tile(1));
  for (std::size_t i = 0; i < 3; ++i) EXPECT_TRUE(same_bits(*journal.find(i), example_tile(i)));
}

TEST_F(JournalTest, AnotherSweepIsRefusedAndItsJournalKept) {
  { Journal(path_, kSweepB).store(0, example_tile(0)); }
  EXPECT_THAT(refusal(kSweepA), AllOf(HasSubstr(path_), HasSubstr("another sweep"),
                                      HasSubstr("delete it"), HasSubstr("another output")));
  EXPECT_THAT(refusal(kSweepA), HasSubstr("study, line 2: 'name = \"duffing\"' there, 'name = "
                                          "\"gear5\"' now"));
  EXPECT_TRUE(same_bits(*Journal(path_, kSweepB).find(0), example_tile(0)));
}

TEST_F(JournalTest, AnotherSweepTakesOverAJournalWithoutTiles) {
  { const Journal empty(path_, kSweepB); }
  { Journal(path_, kSweepA).store(0, example_tile(0)); }
  EXPECT_EQ(Journal(path_, kSweepA).finished_tiles(), 1U);
}

TEST_F(JournalTest, RemoveLeavesNothing) {
  Journal journal(path_, kSweepA);
  journal.store(0, example_tile(0));
  journal.remove();
  EXPECT_TRUE(folder_is_empty());
  EXPECT_EQ(Journal(path_, kSweepB).finished_tiles(), 0U);
}

TEST_F(JournalTest, AnInterruptedRunLeavesOneFile) {
  { Journal(path_, kSweepA).store(0, example_tile(0)); }
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 1);
}

TEST_F(JournalTest, WhatIsKeptLastStands) {
  { Journal(path_, kSweepA).keep({{"tile", "100"}}); }
  Journal journal(path_, kSweepA);
  journal.keep({{"tile", "200"}, {"points", "7"}});
  EXPECT_EQ(journal.note("tile"), "200");
  EXPECT_EQ(journal.note("points"), "7");
  EXPECT_EQ(journal.note("nothing"), "");
}

// While a run finds its step, and builds its kernels.
TEST_F(JournalTest, IsHeldBeforeItsSweepIsKnown) {
  {
    const JournalHold held(path_);
    EXPECT_TRUE(Journal::status(path_).is_held);
    EXPECT_TRUE(Journal::status(path_).notes.empty());
    EXPECT_THAT(refusal(), HasSubstr("in use by another run"));
  }
  EXPECT_TRUE(folder_is_empty());
  {
    JournalHold held(path_);
    Journal(&held, kSweepA).store(0, example_tile(0));
  }
  {
    const JournalHold held(path_);
    EXPECT_EQ(Journal::status(path_).tiles, 1U);
  }
  EXPECT_EQ(Journal(path_, kSweepA).finished_tiles(), 1U);
  EXPECT_THAT(refusal(kSweepB), HasSubstr("another sweep"));
  const JournalHold nothing("");
}

TEST_F(JournalTest, AskingForTheStatusOfNoJournalLeavesNone) {
  EXPECT_THROW(Journal::status(path_), InputError);
  EXPECT_TRUE(folder_is_empty());
}

}  // namespace
}  // namespace gearsweep::testing
