// A page of the documentation as a reader sees it: its text, its links, and its fenced blocks.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace gearsweep::testing {

// What stands between two fences.
struct Block {
  std::string language;  // "sh"
  std::string text;
  std::optional<std::string> not_run;  // the reason, from <!-- not run: REASON --> right before it
  std::size_t line = 0;                // of its first fence, from 1
};

struct Page {
  std::filesystem::path path;
  std::string text;
  std::string prose;  // the text without its fenced blocks
  std::vector<Block> blocks;

  std::string name() const { return path.stem().string(); }
  // The texts of all blocks of a language.
  std::vector<std::string> blocks_of(const std::string& language) const;
  // "doc/orbits.md#one-orbit": where each link and picture leads.
  std::vector<std::string> links() const;
  // What stands in single backticks.
  std::vector<std::string> code() const;
  // What a link to each heading has after its '#', as GitHub makes it.
  std::vector<std::string> anchors() const;
};

// The first group of each place where the pattern is found.
std::vector<std::string> matches_in(const std::string& text, const std::string& pattern);

Page read_page(const std::filesystem::path& path);

// README.md and doc/*.md, in alphabetical order.
std::vector<std::filesystem::path> all_pages();

}  // namespace gearsweep::testing
