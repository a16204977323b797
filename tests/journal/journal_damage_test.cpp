// What is no journal, is damaged or does not fit on the disk never gives a wrong result.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sqlite3.h>
#include <sys/resource.h>

#include <cstring>
#include <optional>
#include <random>
#include <string>

#include "journal/example_journal.hpp"

namespace gearsweep::testing {
namespace {

namespace fs = std::filesystem;
using JournalDamageTest = JournalTest;
using ::testing::AllOf;
using ::testing::HasSubstr;

TEST_F(JournalDamageTest, AFileOfAnotherKindIsRefusedAndKept) {
  const std::string text(5000, 'x');
  write_file(text);
  EXPECT_THAT(refusal(), AllOf(HasSubstr(path_), HasSubstr("not a journal of gearsweep"),
                               HasSubstr("delete it")));
  EXPECT_EQ(read_file(), text);
}

TEST_F(JournalDamageTest, ADatabaseOfAnotherProgramIsRefused) {
  sqlite3* other = nullptr;
  ASSERT_EQ(sqlite3_open(path_.c_str(), &other), SQLITE_OK);
  sqlite3_exec(other, "CREATE TABLE tile(number)", nullptr, nullptr, nullptr);
  sqlite3_close(other);
  EXPECT_THAT(refusal(), HasSubstr("not a journal of gearsweep"));
}

TEST_F(JournalDamageTest, AnEmptyFileIsANewJournal) {
  write_file("");
  EXPECT_EQ(refusal(), "accepted");
}

TEST_F(JournalDamageTest, AFolderThatIsMissingIsARunError) {
  EXPECT_THROW(Journal((folder_ / "none" / "map.journal").string(), kSweepA), RunError);
  EXPECT_TRUE(folder_is_empty());
}

TEST_F(JournalDamageTest, ATruncatedJournalIsRefused) {
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

TEST_F(JournalDamageTest, AChangedResultIsRefused) {
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
TEST_F(JournalDamageTest, AChangedByteNeverGivesAWrongResult) {
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

TEST_F(JournalDamageTest, AJournalThatCannotBeCreatedLeavesNoFile) {
  {
    const FullDisk disk(1000);
    EXPECT_THROW(Journal(path_, kSweepA), RunError);
  }
  EXPECT_TRUE(folder_is_empty());
}

TEST_F(JournalDamageTest, ATileThatDoesNotFitOnTheDiskLeavesTheOthers) {
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

TEST_F(JournalDamageTest, AJournalWhoseFolderIsDeletedSaysSo) {
  Journal journal(path_, kSweepA);
  fs::remove_all(folder_);
  try {
    journal.store(0, example_tile(0));
    FAIL() << "a tile was stored nowhere";
  } catch (const RunError& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr(path_), HasSubstr("no longer there")));
  }
}

}  // namespace
}  // namespace gearsweep::testing
