// Tiles and sweeps made up for the tests of this folder, and a journal's folder for each test.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include "journal/journal.hpp"
#include "model/error.hpp"

namespace gearsweep::testing {

inline const Identity kSweepA = {{"study", "[model]\nname = \"gear5\"\n"}, {"source", "1"}};
inline const Identity kSweepB = {{"study", "[model]\nname = \"duffing\"\n"}, {"source", "1"}};

inline bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0);
}

inline bool same_bits(const TileResult& a, const TileResult& b) {
  return a.status == b.status && same_bits(a.outputs, b.outputs) &&
         same_bits(a.samples, b.samples) && same_bits(a.final_states, b.final_states) &&
         std::memcmp(&a.cost, &b.cost, sizeof a.cost) == 0 && a.device == b.device;
}

// Numbers of any size and sign, drawn from the tile's number.
inline TileResult example_tile(std::size_t number, std::size_t points = 100) {
  std::mt19937_64 random(number + 1);
  std::normal_distribution<double> normal;
  TileResult tile;
  for (std::size_t i = 0; i < points; ++i) {
    tile.status.push_back(static_cast<std::uint8_t>(random()));
    for (int j = 0; j < 3; ++j) tile.outputs.push_back(std::exp(20.0 * normal(random)));
    for (int j = 0; j < 10; ++j) tile.final_states.push_back(normal(random));
    for (int j = 0; j < 20; ++j) tile.samples.push_back(normal(random));
  }
  tile.cost = {normal(random), normal(random), normal(random), normal(random)};
  tile.device = "device " + std::to_string(number % 2);
  return tile;
}

// A folder of its own for each test.
class JournalTest : public ::testing::Test {
 protected:
  JournalTest() {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::temp_directory_path() /
              ("gearsweep_journal_" + std::string(test->name()) + "_" + std::to_string(getpid()));
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
    path_ = (folder_ / "map.nc.journal").string();
  }
  ~JournalTest() override { std::filesystem::remove_all(folder_); }

  std::string refusal(const Identity& identity = kSweepA) const {
    try {
      const Journal journal(path_, identity);
      for (std::size_t i = 0; i < journal.finished_tiles(); ++i) journal.find(i);
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  }

  bool folder_is_empty() const { return std::filesystem::is_empty(folder_); }

  std::string read_file() const {
    std::ifstream in(path_, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  void write_file(const std::string& content) const {
    for (const char* suffix : {"", "-journal"}) std::filesystem::remove(path_ + suffix);
    std::ofstream(path_, std::ios::binary) << content;
  }

  std::filesystem::path folder_;
  std::string path_;
};

}  // namespace gearsweep::testing
