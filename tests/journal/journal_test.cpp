// The journal's promises: what was stored comes back to the bit, also after kill -9; nothing that
// is not a journal of this sweep is taken for one.
#include "journal/journal.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sqlite3.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <optional>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "model/error.hpp"

namespace gearsweep {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

const Identity kSweepA = {{"study", "[model]\nname = \"gear5\"\n"}, {"source", "1"}};
const Identity kSweepB = {{"study", "[model]\nname = \"duffing\"\n"}, {"source", "1"}};

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0);
}

bool same_bits(const TileResult& a, const TileResult& b) {
  return a.status == b.status && same_bits(a.outputs, b.outputs) &&
         same_bits(a.samples, b.samples) && same_bits(a.final_states, b.final_states) &&
         std::memcmp(&a.effort, &b.effort, sizeof a.effort) == 0 && a.device == b.device;
}

// Numbers of any size and sign, drawn from the tile's number.
TileResult example_tile(std::size_t number, std::size_t points = 100) {
  std::mt19937_64 random(number + 1);
  std::normal_distribution<double> normal;
  TileResult tile;
  for (std::size_t i = 0; i < points; ++i) {
    tile.status.push_back(static_cast<std::uint8_t>(random()));
    for (int j = 0; j < 3; ++j) tile.outputs.push_back(std::exp(20.0 * normal(random)));
    for (int j = 0; j < 10; ++j) tile.final_states.push_back(normal(random));
    for (int j = 0; j < 20; ++j) tile.samples.push_back(normal(random));
  }
  tile.effort = {normal(random), normal(random), normal(random), normal(random)};
  tile.device = "device " + std::to_string(number % 2);
  return tile;
}

// A folder of its own for each test.
class JournalTest : public testing::Test {
 protected:
  JournalTest() {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::temp_directory_path() /
              ("gearsweep_journal_" + std::string(test->name()) + "_" + std::to_string(getpid()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    path_ = (folder_ / "map.nc.journal").string();
  }
  ~JournalTest() override { fs::remove_all(folder_); }

  std::string refusal(const Identity& identity = kSweepA) const {
    try {
      const Journal journal(path_, identity);
      for (std::size_t i = 0; i < journal.finished_tiles(); ++i) journal.find(i);
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  }

  bool folder_is_empty() const { return fs::is_empty(folder_); }

  std::string read_file() const {
    std::ifstream in(path_, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  void write_file(const std::string& content) const {
    for (const char* suffix : {"", "-journal"}) fs::remove(path_ + suffix);
    std::ofstream(path_, std::ios::binary) << content;
  }

  fs::path folder_;
  std::string path_;
};

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

TEST_F(JournalTest, AFileOfAnotherKindIsRefusedAndKept) {
  const std::string text(5000, 'x');
  write_file(text);
  EXPECT_THAT(refusal(), AllOf(HasSubstr(path_), HasSubstr("not a journal of gearsweep"),
                               HasSubstr("delete it")));
  EXPECT_EQ(read_file(), text);
}

TEST_F(JournalTest, ADatabaseOfAnotherProgramIsRefused) {
  sqlite3* other = nullptr;
  ASSERT_EQ(sqlite3_open(path_.c_str(), &other), SQLITE_OK);
  sqlite3_exec(other, "CREATE TABLE tile(number)", nullptr, nullptr, nullptr);
  sqlite3_close(other);
  EXPECT_THAT(refusal(), HasSubstr("not a journal of gearsweep"));
}

TEST_F(JournalTest, AnEmptyFileIsANewJournal) {
  write_file("");
  EXPECT_EQ(refusal(), "accepted");
}

TEST_F(JournalTest, AFolderThatIsMissingIsARunError) {
  EXPECT_THROW(Journal((folder_ / "none" / "map.journal").string(), kSweepA), RunError);
  EXPECT_TRUE(folder_is_empty());
}

TEST_F(JournalTest, ATruncatedJournalIsRefused) {
  {
    Journal journal(path_, kSweepA);
    for (std::size_t i = 0; i < 4; ++i) journal.store(i, example_tile(i));
  }
  const std::string whole = read_file();
  for (const std::size_t length : {std::size_t{2}, std::size_t{99}, std::size_t{100},
                                   std::size_t{4096}, whole.size() / 2, whole.size() - 1}) {
    write_file(whole.substr(0, length));
    EXPECT_THAT(refusal(), HasSubstr("not a journal of gearsweep")) << length << " bytes";
  }
}

TEST_F(JournalTest, AChangedResultIsRefused) {
  const TileResult tile = example_tile(0);
  { Journal(path_, kSweepA).store(0, tile); }
  std::string file = read_file();
  std::string number(sizeof(double), '\0');
  std::memcpy(number.data(), &tile.outputs[0], sizeof(double));
  const std::size_t place = file.find(number);
  ASSERT_NE(place, std::string::npos);
  file[place] = static_cast<char>(file[place] ^ 1);
  write_file(file);
  EXPECT_THAT(refusal(), AllOf(HasSubstr("tile 0 was changed"), HasSubstr("delete it")));
}

// A changed byte is harmless (in a part of the file that holds nothing), hides a tile, which is
// then computed again, or is refused. What comes back is never wrong.
TEST_F(JournalTest, AChangedByteNeverGivesAWrongResult) {
  {
    Journal journal(path_, kSweepA);
    for (std::size_t i = 0; i < 3; ++i) journal.store(i, example_tile(i, 20));
  }
  const std::string whole = read_file();
  std::mt19937_64 random(1);
  for (int trial = 0; trial < 400; ++trial) {
    std::string changed = whole;
    char& byte = changed[random() % whole.size()];
    byte = static_cast<char>(byte ^ static_cast<char>(1 + random() % 255));
    write_file(changed);
    try {
      const Journal journal(path_, kSweepA);
      for (std::size_t i = 0; i < 3; ++i) {
        const std::optional<TileResult> found = journal.find(i);
        EXPECT_TRUE(!found || same_bits(*found, example_tile(i, 20))) << "trial " << trial;
      }
    } catch (const InputError&) {
      continue;
    }
  }
}

// Writing beyond `bytes` of a file fails, as on a full disk, while this lives.
class FullDisk {
 public:
  explicit FullDisk(rlim_t bytes) : handler_(signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FullDisk() {
    setrlimit(RLIMIT_FSIZE, &before_);
    signal(SIGXFSZ, handler_);
  }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;

 private:
  void (*handler_)(int);
  rlimit before_{};
};

TEST_F(JournalTest, AJournalThatCannotBeCreatedLeavesNoFile) {
  {
    const FullDisk disk(1000);
    EXPECT_THROW(Journal(path_, kSweepA), RunError);
  }
  EXPECT_TRUE(folder_is_empty());
}

TEST_F(JournalTest, ATileThatDoesNotFitOnTheDiskLeavesTheOthers) {
  Journal journal(path_, kSweepA);
  journal.store(0, example_tile(0));
  {
    const FullDisk disk(fs::file_size(path_) + 10000);
    EXPECT_THROW(journal.store(1, example_tile(1, 100000)), RunError);
  }
  EXPECT_EQ(journal.finished_tiles(), 1U);
  journal.store(2, example_tile(2));
  EXPECT_TRUE(same_bits(*journal.find(0), example_tile(0)));
  EXPECT_TRUE(same_bits(*journal.find(2), example_tile(2)));
}

TEST_F(JournalTest, AJournalWhoseFolderIsDeletedSaysSo) {
  Journal journal(path_, kSweepA);
  fs::remove_all(folder_);
  try {
    journal.store(0, example_tile(0));
    FAIL() << "a tile was stored nowhere";
  } catch (const RunError& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr(path_), HasSubstr("no longer there")));
  }
}

TEST_F(JournalTest, ASecondRunOnTheSameOutputIsRefused) {
  Journal first(path_, kSweepA);
  EXPECT_THAT(refusal(), AllOf(HasSubstr(path_), HasSubstr("in use by another run")));
  first.store(0, example_tile(0));
  EXPECT_TRUE(same_bits(*first.find(0), example_tile(0)));
}

TEST_F(JournalTest, TheLockEndsWithTheJournal) {
  { const Journal first(path_, kSweepA); }
  EXPECT_EQ(refusal(), "accepted");
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

TEST_F(JournalTest, ItsStatusCanBeReadWhileARunHoldsIt) {
  Journal journal(path_, kSweepA);
  journal.keep({{"points", "1000"}});
  journal.store(4, example_tile(4, 30));
  journal.store(7, example_tile(7, 20));
  const JournalStatus status = Journal::status(path_);
  EXPECT_TRUE(status.is_held);
  EXPECT_EQ(status.tiles, 2U);
  EXPECT_EQ(status.points, 50U);
  EXPECT_DOUBLE_EQ(status.seconds,
                   example_tile(4, 30).effort.seconds + example_tile(7, 20).effort.seconds);
  EXPECT_THAT(status.devices, testing::ElementsAre("device 0", "device 1"));
  EXPECT_EQ(status.notes.at("points"), "1000");
  // Reading it has not let go of the run's lock.
  EXPECT_THAT(refusal(), HasSubstr("in use by another run"));
}

TEST_F(JournalTest, ItsStatusSaysThatNoRunHoldsIt) {
  { Journal(path_, kSweepA).store(0, example_tile(0)); }
  EXPECT_FALSE(Journal::status(path_).is_held);
}

TEST_F(JournalTest, AskingForTheStatusOfNoJournalLeavesNone) {
  EXPECT_THROW(Journal::status(path_), InputError);
  EXPECT_TRUE(folder_is_empty());
}

TEST_F(JournalTest, ThreadsMayStoreAtTheSameTime) {
  Journal journal(path_, kSweepA);
  std::vector<std::thread> threads;
  for (std::size_t t = 0; t < 4; ++t) {
    threads.emplace_back([&journal, t] {
      for (std::size_t i = 0; i < 5; ++i) journal.store(5 * t + i, example_tile(5 * t + i));
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (std::size_t i = 0; i < 20; ++i) EXPECT_TRUE(same_bits(*journal.find(i), example_tile(i)));
}

// A child process that stores tiles 0, 1, ... and writes one byte to the pipe for each that it was
// told is durable.
struct Writer {
  pid_t process;
  int acknowledged;  // end of the pipe to read from
};

Writer start_writer(const std::string& path, std::size_t points) {
  int ends[2];
  if (pipe(ends) != 0) throw RunError("no pipe");
  const pid_t process = fork();
  if (process == 0) {
    try {
      Journal journal(path, kSweepA);
      for (std::size_t i = 0;; ++i) {
        journal.store(i, example_tile(i, points));
        if (write(ends[1], "+", 1) != 1) _exit(1);
      }
    } catch (...) {
      _exit(1);
    }
  }
  close(ends[1]);
  return {process, ends[0]};
}

// Waits for `tiles` acknowledgements, kills, and returns how many tiles were acknowledged in all.
std::size_t kill_after(const Writer& writer, std::size_t tiles) {
  std::size_t count = 0;
  char byte = 0;
  while (count < tiles && read(writer.acknowledged, &byte, 1) == 1) ++count;
  kill(writer.process, SIGKILL);
  waitpid(writer.process, nullptr, 0);
  while (read(writer.acknowledged, &byte, 1) == 1) ++count;
  close(writer.acknowledged);
  return count;
}

TEST_F(JournalTest, WhatWasStoredSurvivesKillNine) {
  for (std::size_t trial = 0; trial < 5; ++trial) {
    const std::size_t points = 40 + 400 * trial;
    const Writer writer = start_writer(path_, points);
    const std::size_t stored = kill_after(writer, 3 + 2 * trial);
    ASSERT_GE(stored, 3 + 2 * trial);
    Journal journal(path_, kSweepA);
    // The kill may fall between the commit of one more tile and its acknowledgement.
    EXPECT_GE(journal.finished_tiles(), stored);
    EXPECT_LE(journal.finished_tiles(), stored + 1);
    for (std::size_t i = 0; i < stored; ++i) {
      const std::optional<TileResult> found = journal.find(i);
      EXPECT_TRUE(found && same_bits(*found, example_tile(i, points))) << "tile " << i;
    }
    journal.remove();
    EXPECT_TRUE(folder_is_empty());
  }
}

TEST_F(JournalTest, TheLockOfAnotherProcessEndsWhenItIsKilled) {
  const Writer writer = start_writer(path_, 10);
  char byte = 0;
  EXPECT_EQ(read(writer.acknowledged, &byte, 1), 1);
  EXPECT_THAT(refusal(), HasSubstr("in use by another run"));
  kill_after(writer, 0);
  EXPECT_EQ(refusal(), "accepted");
}

}  // namespace
}  // namespace gearsweep
