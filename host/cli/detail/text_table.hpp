// Rows of words under each other: each column as wide as its longest word.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace gearsweep {

class TextTable {
 public:
  // All rows have as many words as the first.
  void add(std::vector<std::string> row) { rows_.push_back(std::move(row)); }

  // A line for each row, behind `indent` spaces; two columns of space between words.
  std::string text(std::size_t indent = 2) const;

 private:
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace gearsweep
