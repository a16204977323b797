#include "cli/detail/text_table.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace gearsweep {

std::string TextTable::text(std::size_t indent) const {
  std::vector<std::size_t> widths;
  for (const std::vector<std::string>& row : rows_) {
    widths.resize(row.size());
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  }
  std::string text;
  for (const std::vector<std::string>& row : rows_) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      const bool is_last = i + 1 == row.size();
      text += fmt::format("{:{}}{:<{}}", "", i == 0 ? indent : 2, row[i], is_last ? 0 : widths[i]);
    }
    text.erase(text.find_last_not_of(' ') + 1);
    text += '\n';
  }
  return text;
}

}  // namespace gearsweep
