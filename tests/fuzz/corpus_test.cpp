// Every input that the fuzz targets ever tripped over, in ordinary tests too.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "fuzz/targets.hpp"

namespace gearsweep::testing {
namespace {

namespace fs = std::filesystem;

struct Target {
  std::string corpus;
  void (*read)(const std::string&);
};

class CorpusTest : public ::testing::TestWithParam<Target> {};

TEST_P(CorpusTest, IsReadOrRefused) {
  std::size_t count = 0;
  for (const auto& entry : fs::directory_iterator(fs::path(GEARSWEEP_CORPUS) / GetParam().corpus)) {
    SCOPED_TRACE(entry.path().filename().string());
    std::ifstream in(entry.path(), std::ios::binary);
    EXPECT_NO_THROW(GetParam().read({std::istreambuf_iterator<char>(in), {}}));
    ++count;
  }
  EXPECT_GT(count, 0U);
}

INSTANTIATE_TEST_SUITE_P(All, CorpusTest,
                         ::testing::Values(Target{"study", read_hostile_study},
                                           Target{"result", read_hostile_result},
                                           Target{"request", read_hostile_request},
                                           Target{"rexs", read_hostile_rexs}),
                         [](const auto& target) { return target.param.corpus; });

}  // namespace
}  // namespace gearsweep::testing
